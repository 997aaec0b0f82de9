#include "library/exr_pixels.h"

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <exception>
#include <string>

namespace shoal::viz {

Result<Pixels> read_exr(const std::filesystem::path& path) {
  try {
    Imf::InputFile file(path.c_str(), 1);
    const Imath::Box2i window = file.header().dataWindow();
    Pixels pixels;
    pixels.width = window.max.x - window.min.x + 1;
    pixels.height = window.max.y - window.min.y + 1;
    pixels.rgb.resize(std::size_t{3} * pixels.width * pixels.height);
    Imf::FrameBuffer frame;
    const std::size_t texel = 3 * sizeof(float);
    for (int c = 0; c < 3; ++c) {
      frame.insert(std::string(1, "RGB"[c]), Imf::Slice::Make(Imf::FLOAT, pixels.rgb.data() + c,
                                                              window, texel, texel * pixels.width));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return pixels;
  } catch (const std::exception& exception) {
    return Error{ErrorCode::unreadable, exception.what(), path.string(), ""};
  }
}

}  // namespace shoal::viz
