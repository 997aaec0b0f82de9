// Pictures that are stored as six files, a face of a cube each: found by name, read as one.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"
#include "image/panorama_source.h"

namespace shoal {

inline constexpr int kFaceCount = 6;  // +x -x +y -y +z -z: right, left, up, down, front, back

using FacePaths = std::array<std::filesystem::path, kFaceCount>;

// The six files of a picture, from the name of any of them. A name ends, before its extension, with
// one of
//   px nx py ny pz nz          posx negx posy negy posz negz
//   right left up down front back      right left top bottom front back
// in small letters, in capitals, or with a capital first; alone, behind a character that is no
// letter, or with a capital behind a small letter (SkyPosx). Where two rows fit, that whose files exist. Nothing where the name ends otherwise.
[[nodiscard]] std::optional<FacePaths> face_paths(const std::filesystem::path& path);

// The same where all of the files exist.
[[nodiscard]] std::optional<FacePaths> existing_face_paths(const std::filesystem::path& path);

// Six pictures of one size as one, the first on top. Its bands are theirs. options.recorder is left
// alone: there is no one file whose content it could record.
// Errors: those of open_panorama(), and of its bands, each with its own file's name; unsupported
// where the files differ in what a picture has only one of.
Result<std::unique_ptr<PanoramaSource>> open_faces(const FacePaths& paths,
                                                   const ReadOptions& options,
                                                   const ChunkCodecs& codecs);

}  // namespace shoal
