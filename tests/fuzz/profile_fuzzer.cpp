// Any text as a profile: files in its convention, or an error that says where it is; never a crash.
#include "fuzz/fuzz_input.h"
#include "output/profile.h"

namespace shoal::test {
namespace {

// Enough for every profile, and no two numbers alike.
Coefficients some_light() {
  constexpr int kDegree = 8;
  Coefficients light(kDegree);
  for (int c = 0; c < kChannelCount; ++c) {
    for (std::size_t i = 0; i < light.channels[c].size(); ++i) {
      light.channels[c][i] = 1.0 / (1.0 + 3.0 * static_cast<double>(i) + c);
    }
  }
  return light;
}

void check(const std::string& text) {
  const Result<Profile> profile = parse_profile(text, "folder/profile.yaml");
  if (!profile) {
    demand(profile.error().text().starts_with("folder/profile.yaml"), "the error says where");
    return;
  }
  const Coefficients light = some_light();
  if (profile->degree.value_or(light.degree) > light.degree) return;
  const auto first = write_profile_text(*profile, light, {});
  const auto second = write_profile_text(*profile, light, {});
  demand(bool(first) == bool(second) && (!first || *first == *second),
         "the same profile writes the same twice");
}

}  // namespace
}  // namespace shoal::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  shoal::test::check(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
