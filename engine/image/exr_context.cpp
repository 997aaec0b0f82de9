#include "image/exr_context.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>

#include "core/aligned_buffer.h"

// Samples are handed on as they lie in the file, and EXR is little-endian.
static_assert(std::endian::native == std::endian::little);

namespace shoal {
namespace {

// What the library said during the current call on this thread. The first message is the most
// precise one; those that follow come from the callers of the function that failed.
struct Messages {
  std::string first;
  bool system_failed = false;  // the operating system refused a read
};
thread_local Messages messages;

void record_message(exr_const_context_t, exr_result_t, const char* text) {
  if (messages.first.empty() && text) messages.first = text;
}

std::int64_t read_bytes(exr_const_context_t, void* user_data, void* buffer, std::uint64_t size,
                        std::uint64_t offset, exr_stream_error_func_ptr_t) {
  const auto& file = *static_cast<const InputFile*>(user_data);
  const auto got = file.read_some(offset, {static_cast<std::byte*>(buffer), size});
  if (got) return static_cast<std::int64_t>(*got);
  messages.first = got.error().what;
  messages.system_failed = true;
  return -1;
}

std::int64_t file_size(exr_const_context_t, void* user_data) {
  return static_cast<std::int64_t>(static_cast<const InputFile*>(user_data)->size());
}

constexpr std::uint32_t kMultiPartFlag = 0x1000;

// The attributes that say where the pixels are. The library (3.1) makes up what is missing (a
// window of 64 x 64, ZIP for a compression that it does not know), and its C and C++ halves
// disagree about attributes that come twice; so each must be there once, with its own type.
struct RequiredAttribute {
  std::string_view name;
  std::string_view type;
};
constexpr std::array<RequiredAttribute, 4> kRequired = {{{"channels", "chlist"},
                                                         {"compression", "compression"},
                                                         {"dataWindow", "box2i"},
                                                         {"displayWindow", "box2i"}}};

// Walks over the attributes of headers that the library has already found well-formed, to check
// those and to learn where the headers end: the library (3.1) does not tell where its chunk tables
// lie.
class HeaderWalker {
 public:
  explicit HeaderWalker(const InputFile& file) : file_(file), window_(kWindow) {}

  Result<std::uint32_t> read_u32() {
    std::uint32_t value = 0;
    std::byte bytes[sizeof value];
    for (std::byte& byte : bytes) {
      SHOAL_ASSIGN_OR_RETURN(next, read_byte());
      byte = next;
    }
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

  // Walks over one header and the zero byte that ends it; false when it has no attribute at all.
  // Errors: malformed (required attributes), unsupported (compression).
  Result<bool> walk_header() {
    std::array<int, kRequired.size()> seen{};
    for (bool any = false;; any = true) {
      SHOAL_ASSIGN_OR_RETURN(name, read_string());
      if (name.empty() && !any) return false;
      if (name.empty()) break;
      SHOAL_ASSIGN_OR_RETURN(type, read_string());
      SHOAL_ASSIGN_OR_RETURN(size, read_u32());
      const std::uint64_t value = position_;
      for (std::size_t i = 0; i < kRequired.size(); ++i) {
        if (name != kRequired[i].name) continue;
        seen[i] += type == kRequired[i].type ? 1 : 2;  // 2 is wrong, as two of them are
      }
      if (name == "compression") SHOAL_RETURN_IF_ERROR(check_compression());
      position_ = value + size;
    }
    for (std::size_t i = 0; i < kRequired.size(); ++i) {
      if (seen[i] == 1) continue;
      return Error{ErrorCode::malformed,
                   "its header needs one attribute " + std::string(kRequired[i].name) +
                       " of the type " + std::string(kRequired[i].type),
                   file_.path(), "the file is damaged; copy it again"};
    }
    return true;
  }

  [[nodiscard]] std::uint64_t position() const { return position_; }
  void skip_bytes(std::uint64_t count) { position_ += count; }

 private:
  static constexpr std::size_t kWindow = 4096;

  Status check_compression() {
    SHOAL_ASSIGN_OR_RETURN(number, read_byte());
    const int compression = std::to_integer<int>(number);
    if (compression < EXR_COMPRESSION_LAST_TYPE) return {};
    return Error{ErrorCode::unsupported,
                 "is compressed by method " + std::to_string(compression) +
                     ", which the installed OpenEXR does not know",
                 file_.path(), "write it with ZIP or PIZ"};
  }

  Result<std::byte> read_byte() {
    if (position_ < begin_ || position_ >= begin_ + filled_) {
      begin_ = position_;
      SHOAL_ASSIGN_OR_RETURN(got, file_.read_some(begin_, window_.span()));
      filled_ = got;
      if (got == 0) {
        return Error{ErrorCode::malformed, "its header does not end", file_.path(),
                     "the file is cut off; copy it again"};
      }
    }
    return window_[position_++ - begin_];
  }

  Result<std::string> read_string() {
    for (std::string text;;) {
      SHOAL_ASSIGN_OR_RETURN(next, read_byte());
      if (next == std::byte{0}) return text;
      text.push_back(static_cast<char>(next));
    }
  }

  const InputFile& file_;
  AlignedBuffer<std::byte> window_;
  std::uint64_t begin_ = 0;  // of the window in the file
  std::uint64_t filled_ = 0;
  std::uint64_t position_ = 0;
};

}  // namespace

Result<std::shared_ptr<const ExrContext>> ExrContext::open(
    const std::filesystem::path& path, std::shared_ptr<ContentRecorder> recorder) {
  std::shared_ptr<ExrContext> context(new ExrContext);
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path, std::move(recorder)));
  context->file_ = std::move(file);

  exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
  settings.error_handler_fn = &record_message;
  settings.user_data = &context->file_;
  settings.read_fn = &read_bytes;
  settings.size_fn = &file_size;
  SHOAL_RETURN_IF_ERROR(context->run(context->file_.path(), [&] {
    return exr_start_read(&context->handle_, context->file_.path().c_str(), &settings);
  }));
  SHOAL_RETURN_IF_ERROR(context->find_tables());
  return std::shared_ptr<const ExrContext>(std::move(context));
}

ExrContext::~ExrContext() {
  if (handle_) exr_finish(&handle_);
}

void ExrContext::forget_messages() {
  messages.first.clear();
  messages.system_failed = false;
}

Error ExrContext::failure(exr_result_t result, const std::string& where) {
  Error error{
      ErrorCode::malformed, messages.first, where,
      "OpenEXR refuses it: the file is damaged, or was never whole; copy or write it again"};
  if (error.what.empty()) error.what = exr_get_default_error_message(result);
  // The library quotes names out of the file; what a terminal would obey stays out of messages.
  std::replace_if(
      error.what.begin(), error.what.end(),
      [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  if (messages.system_failed) {
    error.code = ErrorCode::unreadable;
  } else if (result == EXR_ERR_FEATURE_NOT_IMPLEMENTED) {
    error.code = ErrorCode::unsupported;
  } else if (result == EXR_ERR_READ_IO) {
    error.what = "ends before its data does";
    error.hint = "the file is cut off; copy it again";
  }
  return error;
}

Status ExrContext::find_tables() {
  int parts = 0;
  SHOAL_RETURN_IF_ERROR(run(file_.path(), [&] { return exr_get_count(handle_, &parts); }));

  HeaderWalker walker(file_);
  walker.skip_bytes(4);  // the magic number
  SHOAL_ASSIGN_OR_RETURN(version, walker.read_u32());
  multi_part_ = (version & kMultiPartFlag) != 0;
  for (bool more = true; more;) {
    SHOAL_ASSIGN_OR_RETURN(any, walker.walk_header());
    more = any && multi_part_;
  }

  std::uint64_t offset = walker.position();
  for (int part = 0; part < parts; ++part) {
    std::int32_t count = 0;
    SHOAL_RETURN_IF_ERROR(
        run(file_.path(), [&] { return exr_get_chunk_count(handle_, part, &count); }));
    const auto entries = static_cast<std::uint64_t>(std::max(count, 0));
    tables_.push_back({offset, entries});
    offset += entries * sizeof(std::uint64_t);
  }
  first_chunk_offset_ = offset;
  if (offset <= file_.size()) return {};
  return Error{ErrorCode::malformed,
               "its table of chunks would end at byte " + std::to_string(offset) +
                   ", but the file has only " + std::to_string(file_.size()),
               file_.path(), "the file is cut off or damaged; copy it again"};
}

}  // namespace shoal
