// The module that knows OpenEXR's C++ classes, loaded when the first file needs it.
#pragma once

#include "core/result.h"
#include "core/row_band.h"
#include "image/module/exr_module.h"

namespace shoal {

// Errors: unsupported (the module is not installed), with an empty `where`.
Result<const exr::Module*> exr_module();

// Of EXR's sample types: half, float32, uint32.
[[nodiscard]] exr::SampleKind exr_sample_kind(SampleType type);

// Tells the module of a failure, through a callback.
exr::Outcome exr_outcome(const Status& status, exr::Message* message);

}  // namespace shoal
