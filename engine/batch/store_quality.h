// The figures of quality of a panorama's variants, rows in the store.
#pragma once

#include <cstdint>

#include "batch/sqlite.h"
#include "batch/store.h"

namespace shoal {

extern const char* const kInsertQuality;
extern const char* const kSelectQuality;  // of an item, in the variants' order

// Runs a prepared kInsertQuality.
Status write_quality(SqlStatement& insert, std::int64_t item, std::int64_t position,
                     const VariantQuality& quality);

// What the current row of kSelectQuality says.
[[nodiscard]] VariantQuality read_quality(const SqlStatement& row);

}  // namespace shoal
