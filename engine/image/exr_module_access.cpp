#include "image/exr_module_access.h"

#include <cstdio>

#include "image/module_loader.h"

namespace shoal {

Result<const exr::Module*> exr_module() {
  static LazyModule module({exr::kModuleFile, exr::kEntryPoint, exr::kInterfaceVersion,
                            "it is part of shoal; install it where it was looked for, or set "
                            "SHOAL_MODULE_PATH to its folder"});
  SHOAL_ASSIGN_OR_RETURN(loaded, module.get());
  return static_cast<const exr::Module*>(loaded);
}

exr::SampleKind exr_sample_kind(SampleType type) {
  if (type == SampleType::half) return exr::kSampleHalf;
  return type == SampleType::float32 ? exr::kSampleFloat : exr::kSampleUint;
}

exr::Outcome exr_outcome(const Status& status, exr::Message* message) {
  if (status) return exr::kOutcomeOk;
  std::snprintf(message->text, sizeof message->text, "%s", status.error().what.c_str());
  return exr::kOutcomeFailed;
}

}  // namespace shoal
