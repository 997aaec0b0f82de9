#include "image/face_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace shoal {
namespace {

using FaceWords = std::array<std::string_view, kFaceCount>;
constexpr FaceWords kWords[] = {{"px", "nx", "py", "ny", "pz", "nz"},
                                {"posx", "negx", "posy", "negy", "posz", "negz"},
                                {"right", "left", "up", "down", "front", "back"},
                                {"right", "left", "top", "bottom", "front", "back"}};

enum class WordCase { small, capitals, capital_first };

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_capital(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

std::string in_case(std::string_view word, WordCase letters) {
  std::string text(word);
  const std::size_t capitals = letters == WordCase::small      ? 0
                               : letters == WordCase::capitals ? text.size()
                                                               : 1;
  for (std::size_t i = 0; i < capitals; ++i) {
    text[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[i])));
  }
  return text;
}

// The word at the end of a file's stem, also of one such as SkyPosx, and what stands before it.
struct StemParts {
  std::string before;
  std::string word;
};

StemParts split_stem(const std::string& stem) {
  std::size_t begin = stem.size();
  while (begin > 0 && is_letter(stem[begin - 1])) {
    const bool begins_behind_small =
        begin < stem.size() && is_capital(stem[begin]) && !is_capital(stem[begin - 1]);
    if (begins_behind_small) break;
    --begin;
  }
  return {stem.substr(0, begin), stem.substr(begin)};
}

WordCase case_of(std::string_view word) {
  if (!is_capital(word.front())) return WordCase::small;
  return is_capital(word.back()) ? WordCase::capitals : WordCase::capital_first;
}

bool all_exist(const FacePaths& paths) {
  return std::ranges::all_of(paths, [](const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
  });
}

struct Faces {
  FacePaths paths;
  std::array<std::unique_ptr<PanoramaSource>, kFaceCount> sources;
  std::array<int, kFaceCount + 1> first_band{};
  PictureInfo info;
};

// Reads bands of the faces as bands of the picture.
class FacesReader final : public BandReader {
 public:
  explicit FacesReader(std::shared_ptr<const Faces> faces) : faces_(std::move(faces)) {}

  Result<RowBand> read(int index) override {
    const auto& first = faces_->first_band;
    const auto behind = std::upper_bound(first.begin(), first.end(), index);
    const int face = static_cast<int>(behind - first.begin()) - 1;
    if (face != face_) {
      SHOAL_ASSIGN_OR_RETURN(reader, faces_->sources[face]->new_reader());
      reader_ = std::move(reader);
      face_ = face;
    }
    SHOAL_ASSIGN_OR_RETURN(band, reader_->read(index - first[face]));
    const int rows_above = face * faces_->sources[face]->info().height;
    band.row_begin += rows_above;
    band.row_end += rows_above;
    return band;
  }

 private:
  std::shared_ptr<const Faces> faces_;
  int face_ = -1;
  std::unique_ptr<BandReader> reader_;
};

class FacesSource final : public PanoramaSource {
 public:
  explicit FacesSource(std::shared_ptr<const Faces> faces) : faces_(std::move(faces)) {}

  [[nodiscard]] const PictureInfo& info() const override { return faces_->info; }

  [[nodiscard]] Result<std::unique_ptr<BandReader>> new_reader() const override {
    return std::unique_ptr<BandReader>(std::make_unique<FacesReader>(faces_));
  }

 private:
  std::shared_ptr<const Faces> faces_;
};

// What a face has that another has not; empty where they go together.
std::string difference(const PictureInfo& info, const PictureInfo& first) {
  if (info.width != first.width || info.height != first.height) {
    return fmt::format("is {} x {} pixels, not {} x {}", info.width, info.height, first.width,
                       first.height);
  }
  if (info.channel_count != first.channel_count) {
    return fmt::format("has {} channels, not {}", info.channel_count, first.channel_count);
  }
  if (info.samples_reversed != first.samples_reversed) return "runs the other way";
  if (info.to_linear_rec709 != first.to_linear_rec709) {
    return "has another exposure or other colours";
  }
  return "";
}

Status check_faces(const Faces& faces) {
  const PictureInfo& first = faces.sources[0]->info();
  for (int face = 0; face < kFaceCount; ++face) {
    const PictureInfo& info = faces.sources[face]->info();
    const std::string where = faces.paths[face].string();
    if (info.scan_axis != ScanAxis::rows) {
      return Error{ErrorCode::unsupported, "is stored by columns, which is not read of faces",
                   where, "store it from the top row down"};
    }
    if (info.height > kMaxSide / kFaceCount) {
      return Error{ErrorCode::unsupported, "is too large for a face", where, ""};
    }
    const std::string what = difference(info, first);
    if (what.empty()) continue;
    return Error{ErrorCode::unsupported,
                 fmt::format("{} as {} is", what, faces.paths[0].filename().string()), where,
                 "the six faces of a cube are alike"};
  }
  return {};
}

PictureInfo info_of(const Faces& faces) {
  PictureInfo info = faces.sources[0]->info();
  info.format += ", six files";
  info.height *= kFaceCount;
  info.band_count = faces.first_band.back();
  info.environment = EnvironmentMap::unsaid;
  info.positions = PixelPositions::centers;
  info.warnings.clear();
  std::set<std::string> told;
  for (const auto& source : faces.sources) {
    const PictureInfo& face = source->info();
    info.rows_per_band = std::max(info.rows_per_band, face.rows_per_band);
    if (face.band_access == BandAccess::sequential) info.band_access = BandAccess::sequential;
    for (const std::string& warning : face.warnings) {
      if (told.insert(warning).second) info.warnings.push_back(warning);
    }
  }
  return info;
}

}  // namespace

std::optional<FacePaths> face_paths(const std::filesystem::path& path) {
  const StemParts parts = split_stem(path.stem().string());
  if (parts.word.empty()) return std::nullopt;
  const WordCase letters = case_of(parts.word);
  std::optional<FacePaths> fitting;
  for (const FaceWords& words : kWords) {
    const bool fits = std::ranges::any_of(
        words, [&](std::string_view word) { return in_case(word, letters) == parts.word; });
    if (!fits) continue;
    FacePaths paths;
    for (int face = 0; face < kFaceCount; ++face) {
      paths[face] = path.parent_path() /
                    (parts.before + in_case(words[face], letters) + path.extension().string());
    }
    if (all_exist(paths)) return paths;
    if (!fitting) fitting = std::move(paths);
  }
  return fitting;
}

std::optional<FacePaths> existing_face_paths(const std::filesystem::path& path) {
  std::optional<FacePaths> paths = face_paths(path);
  return paths && all_exist(*paths) ? paths : std::nullopt;
}

Result<std::unique_ptr<PanoramaSource>> open_faces(const FacePaths& paths,
                                                   const ReadOptions& options,
                                                   const ChunkCodecs& codecs) {
  ReadOptions of_face = options;
  of_face.recorder = nullptr;
  auto faces = std::make_shared<Faces>();
  faces->paths = paths;
  for (int face = 0; face < kFaceCount; ++face) {
    SHOAL_ASSIGN_OR_RETURN(source, open_panorama(paths[face], of_face, codecs));
    faces->first_band[face + 1] = faces->first_band[face] + source->info().band_count;
    faces->sources[face] = std::move(source);
  }
  SHOAL_RETURN_IF_ERROR(check_faces(*faces));
  faces->info = info_of(*faces);
  return std::unique_ptr<PanoramaSource>(std::make_unique<FacesSource>(std::move(faces)));
}

}  // namespace shoal
