// A projection's row in the store, and its sun's.
#pragma once

#include <cstdint>

#include "batch/sqlite.h"
#include "core/result.h"
#include "transform/projector.h"

namespace shoal {

extern const char* const kInsertProjection;
extern const char* const kSelectProjectionByName;  // of the panorama
extern const char* const kSelectProjectionByItem;

// Runs a prepared kInsertProjection.
Status write_projection(SqlStatement& insert, std::int64_t item, const Projection& projection);

extern const char* const kInsertSun;
Status write_sun(SqlStatement& insert, std::int64_t item, const Sun& sun);

// What the current row of such a selection says. Error: malformed.
Result<Projection> read_projection(const SqlStatement& row);

}  // namespace shoal
