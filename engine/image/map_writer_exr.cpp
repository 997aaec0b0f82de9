// OpenEXR maps. The envmap attribute is set only where it is asked for: its border pixels lie on
// the poles or on the edges of faces, those of other maps at their centres. The library lives in a
// module that is loaded when the first map comes.
#include <algorithm>
#include <span>

#include "image/exr_module_access.h"
#include "image/map_formats.h"

namespace shoal {
namespace {

// Where the library's bytes go. A failure is kept, because the library's destructor swallows it.
struct MapBytes {
  AtomicFile file;
  std::uint64_t size = 0;
  Status status = {};
};

exr::Outcome write_output(void* file, std::uint64_t offset, const char* bytes, std::size_t count,
                          exr::Message* message) noexcept {
  auto& out = *static_cast<MapBytes*>(file);
  const auto span = std::as_bytes(std::span(bytes, count));
  const auto within = std::min<std::uint64_t>(count, out.size - std::min(out.size, offset));
  if (out.status && within > 0) out.status = out.file.write_at(offset, span.first(within));
  if (out.status && within < count) out.status = out.file.write(span.subspan(within));
  if (out.status) out.size = std::max(out.size, offset + count);
  return exr_outcome(out.status, message);
}

struct CloseMap {
  const exr::Module* module;
  void operator()(exr::Map* map) const { module->close_map(map); }
};

class ExrMapWriter final : public MapWriter {
 public:
  ExrMapWriter(const std::filesystem::path& path, const MapFile& map, AtomicFile file,
               const exr::Module* module)
      : MapWriter(path, map), bytes_{std::move(file)}, module_(module) {}

  Status open(const MapFile& map) {
    std::vector<exr::Attribute> attributes;
    for (const auto& [name, text] : map.attributes) {
      attributes.push_back({name.c_str(), text.c_str()});
    }
    const exr::SampleKind kind =
        map.format == MapFormat::exr_half ? exr::kSampleHalf : exr::kSampleFloat;
    const exr::Environment environment = map.environment == MapFile::Environment::cube
                                             ? exr::kEnvironmentCube
                                             : exr::kEnvironmentNone;
    const exr::MapHeader header{width_,      height_,           kind,
                                environment, attributes.data(), attributes.size()};
    const exr::Output output{&bytes_, path_.c_str(), write_output};
    exr::Map* created = nullptr;
    exr::Message message{};
    const auto outcome = module_->create_map(&header, &output, &created, &message);
    map_ = Handle(created, CloseMap{module_});
    return told(outcome, message);
  }

 private:
  using Handle = std::unique_ptr<exr::Map, CloseMap>;

  Status encode_rows(const std::array<const float*, 3>& planes, std::ptrdiff_t stride,
                     int row_count) override {
    exr::Message message{};
    const auto outcome =
        module_->write_rows(map_.get(), planes.data(), stride, row_count, &message);
    return told(outcome, message);
  }

  Status finish() override {
    exr::Message message{};
    const auto outcome = module_->finish_map(map_.get(), &message);
    SHOAL_RETURN_IF_ERROR(told(outcome, message));
    SHOAL_RETURN_IF_ERROR(bytes_.status);
    return bytes_.file.commit();
  }

  // What the file has against it comes before what the library says to that.
  [[nodiscard]] Status told(exr::Outcome outcome, const exr::Message& message) const {
    if (outcome == exr::kOutcomeOk) return {};
    return bytes_.status ? Status(write_error(message.text)) : bytes_.status;
  }

  MapBytes bytes_;
  const exr::Module* module_;
  Handle map_{nullptr, CloseMap{nullptr}};
};

}  // namespace

MapWriterResult create_exr_map(const std::filesystem::path& path, const MapFile& map) {
  auto module = exr_module();
  if (!module) {
    module.error().where = path.string();
    return std::move(module).error();
  }
  SHOAL_ASSIGN_OR_RETURN(file, AtomicFile::create(path));
  auto writer = std::make_unique<ExrMapWriter>(path, map, std::move(file), *module);
  SHOAL_RETURN_IF_ERROR(writer->open(map));
  return std::unique_ptr<MapWriter>(std::move(writer));
}

}  // namespace shoal
