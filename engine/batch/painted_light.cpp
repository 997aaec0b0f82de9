#include "batch/painted_light.h"

#include <memory>
#include <utility>
#include <vector>

#include "core/content_hash.h"
#include "transform/painted_source.h"

namespace shoal {
namespace {

constexpr int kPictureWidth = 1024;
constexpr int kPictureHeight = 512;

// The sky and its ground without the sun.
Painting sky_painting(const std::shared_ptr<const PreethamModel>& model, int width, int height) {
  return {"Preetham sky",
          width,
          height,
          [model](const glm::dvec3& direction) { return model->radiance(direction); },
          {},
          {}};
}

// Everything that an entry holds, sun and lights included.
Painting whole_painting(const EntrySettings& settings, int width, int height) {
  const std::vector<AnalyticLight> lights = native_lights(settings);
  Painting painting = painting_of(lights, width, height);
  if (!settings.sky) return painting;
  const auto model = std::make_shared<const PreethamModel>(settings.sky->model);
  if (settings.sky->disk == SunDisk::shown) painting.disks.push_back(model->sun());
  painting.radiance = [model, others = painting.radiance](const glm::dvec3& direction) {
    const glm::dvec3 sky = model->radiance(direction);
    return others ? sky + others(direction) : sky;
  };
  return painting;
}

MapFormat format_of(const PictureRequest& picture) {
  if (picture.format == MapFileType::hdr) return MapFormat::hdr;
  return picture.samples == MapSamples::half ? MapFormat::exr_half : MapFormat::exr_float;
}

}  // namespace

PaintedPanorama painted_sky(const std::string& name, const SkyKey& sky) {
  const auto model = std::make_shared<const PreethamModel>(sky.model);
  PaintedPanorama panorama{name, nullptr, {}};
  // A key's size is one that can be painted.
  auto source = paint(sky_painting(model, sky.width, sky.height));
  panorama.source = std::move(source).value();
  if (sky.disk == SunDisk::shown) panorama.lights.emplace_back(model->sun());
  return panorama;
}

PictureFile picture_file(const PanoramaEntry& entry) {
  const EntrySettings& settings = *entry.settings;
  const PictureRequest& picture = *settings.picture;
  PictureFile file{"maps/" + entry.name + ".picture", picture.width, picture.height};
  file.name += picture.format == MapFileType::hdr ? ".hdr" : ".exr";
  if (file.width == 0) {
    file.width = settings.sky ? settings.sky->width : kPictureWidth;
    file.height = settings.sky ? settings.sky->height : kPictureHeight;
  }
  return file;
}

Result<OutputRecord> write_picture_file(const Manifest& manifest, const PanoramaEntry& entry) {
  const PictureFile picture = picture_file(entry);
  SHOAL_ASSIGN_OR_RETURN(source,
                         paint(whole_painting(*entry.settings, picture.width, picture.height)));
  MapFile file;
  file.format = format_of(*entry.settings->picture);
  file.width = picture.width;
  file.height = picture.height;
  file.attributes = {{"shoal:panorama", entry.name}};
  const std::filesystem::path path = manifest.output / picture.name;
  SHOAL_RETURN_IF_ERROR(write_picture(*source, path, file));
  SHOAL_ASSIGN_OR_RETURN(hash, hash_file(path));
  std::error_code ignored;
  return OutputRecord{picture.name, "picture", hash, std::filesystem::file_size(path, ignored)};
}

}  // namespace shoal
