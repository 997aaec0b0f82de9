// The files of manifests/profiles/ as the build has compiled them in. Nothing is read at run time,
// and nothing is parsed before somebody asks.
#pragma once

#include <span>
#include <string_view>

namespace shoal {

struct BuiltinProfile {
  std::string_view name;
  std::string_view text;
};

// In bytewise order of their names.
[[nodiscard]] std::span<const BuiltinProfile> builtin_profiles();

}  // namespace shoal
