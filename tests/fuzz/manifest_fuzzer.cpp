// Any text as a manifest: what it asks for, or errors that say where they are; never a crash.
#include "batch/manifest.h"
#include "fuzz/fuzz_input.h"

namespace shoal::test {
namespace {

void check(const ManifestResult& result) {
  demand(result.manifest.has_value() == (result.error_count == 0), "a manifest, or errors");
  demand(result.messages.empty() == result.diagnostics.empty(), "what is wrong is told");
  if (!result.manifest) return;
  demand(!result.manifest->variants.empty(), "there is a variant");
  demand(!result.manifest->entries.empty() || !result.diagnostics.empty(),
         "a manifest without panoramas is worth a word");
}

}  // namespace
}  // namespace shoal::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const shoal::test::MemoryFile file({data, size});
  shoal::test::check(shoal::load_manifest(file.path()));
  return 0;
}
