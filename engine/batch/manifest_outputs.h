// What a manifest would write, checked before anything is.
#pragma once

#include "batch/manifest.h"
#include "batch/manifest_log.h"

namespace shoal {

// Tells maps and exports that would have one file's name, exports that want a higher degree, tables that cannot hold what is asked for, and
// colours that come out infinite. `tables_loc` is the place of tables:, which may be none.
void check_outputs(const Manifest& manifest, const SourceLoc& tables_loc, ManifestLog& log);

}  // namespace shoal
