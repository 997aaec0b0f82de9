// Rows of the store's table of written files.
#pragma once

#include "batch/sqlite.h"
#include "batch/store.h"

namespace shoal {

inline constexpr const char* kInsertOutput =
    "INSERT OR REPLACE INTO outputs (item, path, kind, content_hash, size) VALUES (?,?,?,?,?)";

// Of the columns item, path, kind, content_hash, size.
inline OutputRecord read_output(const SqlStatement& row) {
  return {row.text(1), row.text(2), row.text(3), static_cast<std::uint64_t>(row.integer(4))};
}

}  // namespace shoal
