#include "transform/layout_source.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <utility>

#include "image/face_files.h"

namespace shoal {
namespace {

// Five faces of a cube, or three, are no five angular maps. Two files may be named left and right
// for other reasons.
Status check_whole(const std::filesystem::path& path) {
  constexpr int kTellingFaces = 3;
  const std::optional<FacePaths> faces = face_paths(path);
  if (!faces) return {};
  int found = 0;
  std::string missing;
  for (const std::filesystem::path& face : *faces) {
    std::error_code ignored;
    const bool exists = std::filesystem::exists(face, ignored);
    found += exists ? 1 : 0;
    if (!exists) missing = face.filename().string();
  }
  if (found < kTellingFaces || found == kFaceCount) return {};
  return Error{ErrorCode::not_found,
               fmt::format("{} of the six faces of a cube are here; one that is missing is {}",
                           found, missing),
               path.string(), "name the layout, where they are no faces"};
}

std::optional<FacePaths> faces_for(const std::filesystem::path& path, Layout asked) {
  if (asked == Layout::cube_faces) return face_paths(path);
  if (asked == Layout::automatic) return existing_face_paths(path);
  return std::nullopt;
}

std::string_view sign_of(EnvironmentMap environment) {
  return environment == EnvironmentMap::cube ? "its envmap attribute" : "the header of its file";
}

Layout layout_of(EnvironmentMap environment) {
  switch (environment) {
    case EnvironmentMap::cube:
      return Layout::cube_openexr;
    case EnvironmentMap::cube_strip:
      return Layout::cube_vertical_strip;
    default:
      return Layout::equirect;
  }
}

void choose_by_aspect(LaidOutPicture& picture) {
  const PictureInfo& info = picture.source->info();
  const std::optional<Layout> guess = layout_of_aspect(info.width, info.height);
  picture.layout = guess.value_or(Layout::equirect);
  if (!guess) {
    picture.notes.push_back(
        fmt::format("its {} x {} pixels have the aspect of no layout; it was taken for equirect",
                    info.width, info.height));
  } else if (*guess == Layout::angular) {
    picture.notes.push_back(
        "it was taken for an angular map, because it is square; a mirror-ball, an octahedral or an "
        "octahedral-equal-area map must be named as layout");
  } else if (*guess != Layout::equirect) {
    picture.notes.push_back(fmt::format("it was taken for a {}, because its aspect is {}",
                                        name_of(*guess), aspect_of(*guess)));
  }
}

// Equirect is what nobody asked for, perhaps. A crop of a hundredth is no other layout.
void doubt_by_aspect(LaidOutPicture& picture) {
  const PictureInfo& info = picture.source->info();
  if (std::abs(info.width - 2 * info.height) * 100 <= info.width) return;
  picture.notes.push_back(
      fmt::format("its {} x {} pixels are not twice as wide as high, as an equirect panorama is; "
                  "another layout must be named, or be found by layout auto",
                  info.width, info.height));
}

void choose_layout(Layout asked, LaidOutPicture& picture) {
  const EnvironmentMap environment = picture.source->info().environment;
  if (environment == EnvironmentMap::unsaid) {
    picture.layout = asked;
    if (asked == Layout::automatic) choose_by_aspect(picture);
    if (asked == Layout::equirect) doubt_by_aspect(picture);
    return;
  }
  picture.layout = layout_of(environment);
  const bool agrees = asked == Layout::automatic || asked == picture.layout ||
                      asked == Layout::equirect;  // the default, so perhaps not asked for
  if (agrees) {
    const bool is_news = asked != picture.layout && picture.layout != Layout::equirect;
    if (!is_news) return;
    picture.recognised =
        fmt::format("it is {} by {}", name_of(picture.layout), sign_of(environment));
    return;
  }
  picture.notes.push_back(fmt::format("the file says that it is {}, so it was not taken for {}",
                                      name_of(picture.layout), name_of(asked)));
}

Error no_face(const std::filesystem::path& path) {
  return Error{
      ErrorCode::usage, "its name does not end with that of a cube's face", path.string(),
      "six files such as sky_px.hdr, sky_nx.hdr, ...: px nx py ny pz nz, posx ... negz, or "
      "right left up down front back"};
}

}  // namespace

Result<LaidOutPicture> open_picture(const std::filesystem::path& path, const ReadOptions& options,
                                    const ChunkCodecs& codecs, Layout asked) {
  LaidOutPicture picture;
  if (const std::optional<FacePaths> faces = faces_for(path, asked)) {
    SHOAL_ASSIGN_OR_RETURN(source, open_faces(*faces, options, codecs));
    picture.source = std::move(source);
    picture.layout = Layout::cube_faces;
    picture.files.assign(faces->begin(), faces->end());
    if (asked == Layout::automatic) {
      picture.recognised =
          fmt::format("it is {} by the names of six files, {} to {}", name_of(picture.layout),
                      faces->front().filename().string(), faces->back().filename().string());
    }
    return picture;
  }
  if (asked == Layout::cube_faces) return no_face(path);
  if (asked == Layout::automatic) SHOAL_RETURN_IF_ERROR(check_whole(path));
  SHOAL_ASSIGN_OR_RETURN(source, open_panorama(path, options, codecs));
  picture.source = std::move(source);
  picture.files = {path};
  choose_layout(asked, picture);
  return picture;
}

std::vector<std::filesystem::path> picture_files(const std::filesystem::path& path, Layout asked) {
  const std::optional<FacePaths> faces = faces_for(path, asked);
  if (!faces) return {path};
  return {faces->begin(), faces->end()};
}

}  // namespace shoal
