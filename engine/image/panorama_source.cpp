#include "image/panorama_source.h"

#include <string_view>

#include "core/input_file.h"
#include "image/exr_source.h"
#include "image/module_source.h"
#include "image/radiance_header.h"
#include "image/radiance_source.h"

namespace shoal {
namespace {

constexpr std::string_view kExrMagic("\x76\x2f\x31\x01", 4);

}  // namespace

Result<std::unique_ptr<PanoramaSource>> open_panorama(const std::filesystem::path& path,
                                                      const ReadOptions& options,
                                                      const ChunkCodecs& codecs) {
  std::string first_bytes(kRadianceSignatureBytes, '\0');
  {
    SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));
    SHOAL_ASSIGN_OR_RETURN(got, file.read_some(0, std::as_writable_bytes(std::span(first_bytes))));
    first_bytes.resize(got);
  }
  if (first_bytes.empty()) {
    return Error{ErrorCode::malformed, "is empty", path.string(), "copy or write the file again"};
  }
  if (first_bytes.starts_with(kExrMagic)) return open_exr(path, options, codecs);
  if (looks_like_radiance(first_bytes)) return open_radiance(path, options);
  return open_with_module(path, options);
}

}  // namespace shoal
