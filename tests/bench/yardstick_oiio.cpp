#include <OpenImageIO/imageio.h>

#include "bench/oiio_picture.h"
#include "bench/yardstick.h"

namespace shoal::bench {

Status read_with_oiio(const std::string& path, OiioPicture& picture) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return Error{ErrorCode::unreadable, OIIO::geterror(), path, ""};
  const OIIO::ImageSpec& spec = input->spec();
  picture.width = spec.width;
  picture.height = spec.height;
  picture.channel_count = spec.nchannels;
  const auto count = static_cast<std::size_t>(spec.image_pixels()) * spec.nchannels;
  if (picture.capacity < count) {
    picture.samples = std::make_unique_for_overwrite<float[]>(count);
    picture.capacity = count;
  }
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.samples.get())) {
    return Error{ErrorCode::unreadable, input->geterror(), path, ""};
  }
  return {};
}

void set_oiio_threads(int threads) {
  OIIO::attribute("threads", threads);
  // OpenEXR counts the threads beside the calling one; -1 is OpenImageIO's word for none.
  OIIO::attribute("exr_threads", threads > 1 ? threads : -1);
}

Seconds time_oiio(const YardstickWork& work) {
  set_oiio_threads(work.threads);
  OiioPicture picture;
  return repeated(work.repeat, [&]() -> Status {
    for (const std::string& file : work.files) {
      if (work.buffer == SampleBuffer::fresh) picture = {};
      SHOAL_RETURN_IF_ERROR(read_with_oiio(file, picture));
    }
    return {};
  });
}

std::string oiio_version() { return OIIO_VERSION_STRING; }

}  // namespace shoal::bench
