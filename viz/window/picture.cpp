#include "window/picture.h"

#include <png.h>

#include <string>
#include <string_view>

#include "core/atomic_file.h"

namespace shoal::viz {

Status write_png(const Picture& picture, const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.size.width);
  image.height = static_cast<png_uint_32>(picture.size.height);
  image.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr)) {
    return Error{ErrorCode::write_failed, "cannot be made a PNG: " + std::string(image.message),
                 path.string(), ""};
  }
  return write_file_atomically(path, std::string_view(bytes.data(), size));
}

Result<Picture> read_png(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) {
    return Error{ErrorCode::not_found, "there is no such picture", path.string(), ""};
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto failure = [&] {
    return Error{ErrorCode::malformed, "cannot be read as PNG: " + std::string(image.message),
                 path.string(), ""};
  };
  if (!png_image_begin_read_from_file(&image, path.c_str())) return failure();
  image.format = PNG_FORMAT_RGB;
  Picture picture{{static_cast<int>(image.width), static_cast<int>(image.height)}, {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  const png_color black{0, 0, 0};
  if (!png_image_finish_read(&image, &black, picture.rgb.data(), 0, nullptr)) return failure();
  return picture;
}

}  // namespace shoal::viz
