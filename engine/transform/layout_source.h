// Opening a picture in whichever layout it has.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "image/panorama_source.h"
#include "sphere/layout.h"

namespace shoal {

struct LaidOutPicture {
  std::unique_ptr<PanoramaSource> source;
  Layout layout = Layout::equirect;          // never automatic
  std::vector<std::filesystem::path> files;  // one, or six, each a sixth of the rows
  std::vector<std::string> notes;            // what was guessed, or not followed; sentences
  // What the file or its name says of the layout where nobody asked for it and it is not equirect:
  // "it is cube-openexr by its envmap attribute". Else empty.
  std::string recognised;
};

// Opens a picture of the layout asked for. What a file says itself wins: EXR's envmap attribute, a
// DDS cube map.
// cube_faces opens the six files that `path` is one of, by their names (image/face_files.h).
// automatic takes the first of: what the file says; six files by name, if all are there; the aspect
// (layout_of_aspect); equirect. A guess by the aspect that is not 2:1 is noted.
// Errors: open_panorama()'s, open_faces()'s; usage (a name that is none of a face's).
Result<LaidOutPicture> open_picture(const std::filesystem::path& path, const ReadOptions& options,
                                    const ChunkCodecs& codecs, Layout asked);

// The files that open_picture() reads, without opening any: one or six.
[[nodiscard]] std::vector<std::filesystem::path> picture_files(const std::filesystem::path& path,
                                                               Layout asked);

}  // namespace shoal
