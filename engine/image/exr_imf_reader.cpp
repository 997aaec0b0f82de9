#include "image/exr_imf_reader.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "image/exr_module_access.h"

namespace shoal {
namespace {

// What the library refuses is broken; that the module is absent is told in its own words.
Error damaged(const exr::Message& message, std::string where) {
  return Error{ErrorCode::malformed, message.text, std::move(where),
               "the file is damaged; copy it again"};
}

exr::Outcome read_input(const void* file, std::uint64_t offset, char* bytes, std::size_t count,
                        exr::Message* message) noexcept {
  const std::span<std::byte> out = std::as_writable_bytes(std::span(bytes, count));
  const auto got = static_cast<const InputFile*>(file)->read_some(offset, out);
  if (!got) return exr_outcome(got.error(), message);
  if (*got == count) return exr::kOutcomeOk;
  return exr_outcome(Error{ErrorCode::malformed, "ends before its data does", "", ""}, message);
}

struct ClosePicture {
  const exr::Module* module;
  void operator()(exr::Picture* picture) const { module->close_picture(picture); }
};
using PictureHandle = std::unique_ptr<exr::Picture, ClosePicture>;

Result<PictureHandle> open_picture(const ExrPicture& picture, exr::PictureKind kind) {
  const InputFile& file = picture.context->file();
  auto module = exr_module();
  if (!module) {
    module.error().where = file.path();
    return std::move(module).error();
  }
  std::vector<exr::Channel> channels;
  for (const ExrChannel& channel : picture.part.channels) {
    channels.push_back({channel.name.c_str(), exr_sample_kind(channel.type), channel.x_sampling,
                        channel.y_sampling});
  }
  const ExrWindow& data = picture.part.data;
  const exr::Part part{
      picture.part.index, picture.layer.c_str(), data.x_begin,   data.y_begin, data.x_end,
      data.y_end,         channels.data(),       channels.size()};
  const exr::Input input{&file, file.path().c_str(), file.size(), read_input};
  exr::Picture* opened = nullptr;
  exr::Message message{};
  if ((*module)->open_picture(kind, &part, &input, &opened, &message) != exr::kOutcomeOk) {
    return damaged(message, file.path());
  }
  return PictureHandle(opened, ClosePicture{*module});
}

class ImfReader final : public ExrBandReader {
 public:
  ImfReader(std::shared_ptr<const ExrPicture> shared, PictureHandle handle)
      : ExrBandReader(std::move(shared)), rows_(picture()), handle_(std::move(handle)) {}

 private:
  Status decode(const ExrBand& band, RowBand& rows) override {
    const int first_row = band.row_begin - layout().row_of_chunk(band.chunk_begin);
    const int first_line = picture().part.data.y_begin + band.row_begin - layout().data_y;
    std::array<exr::Plane, kMaxChannels> planes;
    for (int c = 0; c < rows.channel_count; ++c) {
      const std::string& name = picture().part.channels[picture().colour.channels[c]].name;
      planes[c] = {name.c_str(), exr_sample_kind(rows.channels[c].type),
                   reinterpret_cast<char*>(rows_.sample(c, first_row)), rows_.row_stride(c)};
    }
    exr::Message message{};
    const auto outcome = handle_.get_deleter().module->read_lines(
        handle_.get(), first_line, first_line + band.row_end - band.row_begin, planes.data(),
        static_cast<std::size_t>(rows.channel_count), &message);
    if (outcome != exr::kOutcomeOk) return damaged(message, picture().where(band.row_begin));
    rows_.show(band, rows);
    return {};
  }

  ExrPlanarRows rows_;
  PictureHandle handle_;
};

}  // namespace

Result<std::unique_ptr<BandReader>> new_exr_imf_reader(std::shared_ptr<const ExrPicture> picture) {
  const bool chroma = picture->colour.model == ExrColourModel::luminance_chroma;
  SHOAL_ASSIGN_OR_RETURN(
      handle, open_picture(*picture, chroma ? exr::kPictureLuminanceChroma : exr::kPicturePlanes));
  return std::unique_ptr<BandReader>(
      std::make_unique<ImfReader>(std::move(picture), std::move(handle)));
}

}  // namespace shoal
