#include "batch/manifest_document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "core/input_file.h"
#include "output/text_quoting.h"

namespace shoal {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20;
constexpr std::string_view kNotAManifest = "a manifest is YAML text; shoal init DIR writes one";

SourceLoc position_of(const std::string& path, std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {path, static_cast<int>(line) + 1, static_cast<int>(offset - start) + 1};
}

std::string_view line_at(std::string_view text, int line) {
  for (int i = 1; i < line; ++i) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find_first_of("\r\n"));
}

// Whether the text is UTF-8 without characters that no YAML text has; tells the first that is not.
bool check_characters(const std::string& path, std::string_view text, ManifestLog& log) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    log.error({path}, "this is UTF-16 text", "save it as UTF-8");
    return false;
  }
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length_at(text, i);
    if (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') {
      log.error({path}, "this is not text: it holds control characters",
                std::string(kNotAManifest));
      return false;
    }
    if (length == 0) {
      log.error({path, position_of(path, text, i).line},
                fmt::format("the byte 0x{:02x} is not UTF-8", byte), "save the file as UTF-8");
      return false;
    }
    i += length;
  }
  return true;
}

struct Explanation {
  std::string_view yaml_message;  // what yaml-cpp's begins with
  std::string_view message;
  std::string_view hint;
};

// yaml-cpp's own words, told for somebody who knows YAML a little.
constexpr Explanation kExplanations[] = {
    {"illegal map value", "a \":\" where no key can stand",
     "check the indentation, and put values that hold \": \" in quotes"},
    {"the referenced anchor", "a \"*\" begins a YAML alias here",
     "put patterns in quotes: \"*.hdr\""},
    {"alias not found", "a \"*\" begins a YAML alias here", "put patterns in quotes: \"*.hdr\""},
    {"illegal character found while scanning alias", "a \"*\" begins a YAML alias here",
     "put patterns in quotes: \"*.hdr\""},
    {"illegal EOF in scalar", "a quote is never closed", "close it at the end of the value"},
    {"unknown token", "no value can begin with this character", "put the value in quotes"},
    {"illegal block entry", "a \"- \" where no list can begin",
     "begin the list on a line of its own"},
    {"illegal flow end", "a closing bracket that nothing opens", "put the value in quotes"},
    {"bad file", "nested too deeply", "a manifest needs five levels at most"},
    {"end of map not found", "this does not belong to the mapping above it",
     "check the indentation"},
    {"end of sequence not found", "this does not belong to the list above it",
     "check the indentation"},
};

// Where the bracket stands that yaml-cpp still waited for at `loc`, or `loc`.
SourceLoc opening_bracket(const SourceLoc& loc, std::string_view text, char open, char close) {
  std::size_t end = 0;
  for (int line = 1; line < loc.line; ++line)
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  end = std::min(end + static_cast<std::size_t>(loc.column - 1), text.size());
  int depth = 0;
  while (end-- > 0) {
    if (text[end] == close) ++depth;
    if (text[end] == open && depth-- == 0) return position_of(loc.file, text, end);
  }
  return loc;
}

void tell_syntax_error(const std::string& path, std::string_view text,
                       const YAML::Exception& exception, ManifestLog& log) {
  const SourceLoc loc{path, exception.mark.line + 1, exception.mark.column + 1};
  const std::string_view line = line_at(text, loc.line);
  const std::size_t indent = std::min(line.find_first_not_of(" \t"), line.size());
  const std::size_t tab = line.substr(0, indent).find('\t');
  if (tab != std::string_view::npos) {
    return log.error({path, loc.line, static_cast<int>(tab) + 1}, "a tab in the indentation",
                     "YAML indents with spaces");
  }
  const std::string_view yaml_message = exception.msg;
  if (yaml_message.starts_with("end of map flow") && line.find("${") != std::string_view::npos) {
    return log.error(log.find_in_line({path, loc.line, 1}, "${"), "this \"{\" is not closed",
                     "put values that hold ${...} in quotes between { } or [ ]");
  }
  if (yaml_message.starts_with("end of map flow")) {
    return log.error(opening_bracket(loc, text, '{', '}'), "this \"{\" is not closed",
                     "close it with \"}\"");
  }
  if (yaml_message.starts_with("end of sequence flow")) {
    return log.error(opening_bracket(loc, text, '[', ']'), "this \"[\" is not closed",
                     "close it with \"]\"");
  }
  for (const Explanation& explanation : kExplanations) {
    if (!yaml_message.starts_with(explanation.yaml_message)) continue;
    return log.error(loc, std::string(explanation.message), std::string(explanation.hint));
  }
  log.error(loc, "not YAML: " + exception.msg);
}

// The last scalar of a tree in the order of the text. Aliases may make a tree endless; yaml-cpp
// itself nests no deeper than kMaxDepth.
YAML::Node last_scalar(YAML::Node node) {
  constexpr int kMaxDepth = 1000;
  for (int depth = 0; depth < kMaxDepth && (node.IsMap() || node.IsSequence()); ++depth) {
    YAML::Node last;
    for (const auto& item : node) last.reset(node.IsMap() ? item.second : YAML::Node(item));
    if (node.size() == 0) return node;
    node.reset(last);
  }
  return node;
}

// yaml-cpp takes a quote that is never closed to end with the file. Only the last scalar can be
// one.
bool check_last_quote(const ManifestDocument& document, std::string_view text, ManifestLog& log) {
  const SourceLoc loc = document.loc(last_scalar(document.root));
  const std::string_view line = line_at(text, loc.line);
  if (line.size() < static_cast<std::size_t>(loc.column)) return true;
  const char quote = line[loc.column - 1];
  if (quote != '"' && quote != '\'') return true;
  const char* begin = line.data() + loc.column;
  for (std::string_view rest(begin, text.data() + text.size()); !rest.empty();) {
    const bool skips = quote == '"' ? rest[0] == '\\' : rest.starts_with("''");
    if (!skips && rest[0] == quote) return true;
    rest.remove_prefix(std::min<std::size_t>(skips ? 2 : 1, rest.size()));
  }
  log.error(loc, "this quote is never closed", "close it at the end of the value");
  return false;
}

// Hears of a stream's documents only where they begin.
class DocumentStarts : public YAML::EventHandler {
 public:
  std::vector<YAML::Mark> marks;

  void OnDocumentStart(const YAML::Mark& mark) override { marks.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// The one document of the text; null, with an error in the log, where there is another number of
// them. YAML::LoadAll must not be asked: it finds documents without end behind a stray comma.
std::optional<YAML::Node> parse_yaml(const std::string& path, const std::string& text,
                                     ManifestLog& log) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    DocumentStarts starts;
    while (starts.marks.size() < 2 && parser.HandleNextDocument(starts)) continue;
    if (starts.marks.size() < 2) return YAML::Load(text);
    const SourceLoc loc{path, starts.marks[1].line + 1, starts.marks[1].column + 1};
    if (line_at(text, loc.line).starts_with("---")) {
      log.error(loc, "a second document begins here", "a manifest is a single one");
    } else {
      log.error(loc, "this does not belong to what stands above it", "check the indentation");
    }
  } catch (const YAML::Exception& exception) {
    tell_syntax_error(path, text, exception, log);
  }
  return std::nullopt;
}

Result<std::string> read_text(const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));
  if (file.size() > kMaxBytes) {
    return Error{ErrorCode::usage, "this is larger than a manifest can be (64 MiB)", path.string(),
                 std::string(kNotAManifest)};
  }
  std::string text(file.size(), '\0');
  SHOAL_RETURN_IF_ERROR(file.read_exactly(0, std::as_writable_bytes(std::span(text))));
  return text;
}

}  // namespace

SourceLoc ManifestDocument::loc(const YAML::Node& node) const {
  const YAML::Mark mark = node.Mark();
  return {path, mark.line + 1, mark.column + 1};
}

std::shared_ptr<const ManifestDocument> parse_document(const std::filesystem::path& path,
                                                       std::string text, ManifestLog& log) {
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  const std::string shown = path.string();
  log.add_text(shown, text);
  if (!check_characters(shown, text, log)) return nullptr;
  const std::optional<YAML::Node> root = parse_yaml(shown, text, log);
  if (!root) return nullptr;
  if (root->IsNull()) {
    log.error({shown}, "the manifest is empty",
              "shoal init DIR writes one for a folder of panoramas");
    return nullptr;
  }
  auto document = std::make_shared<ManifestDocument>();
  document->path = shown;
  document->folder = path.parent_path();
  document->root = *root;
  if (!document->root.IsMap()) {
    log.error(document->loc(document->root), "a manifest is a mapping of keys to values",
              "it begins with \"shoal: 1\"; shoal init DIR writes one");
    return nullptr;
  }
  return check_last_quote(*document, text, log) ? document : nullptr;
}

std::shared_ptr<const ManifestDocument> load_document(const std::filesystem::path& path,
                                                      const SourceLoc& named_at, ManifestLog& log) {
  Result<std::string> text = read_text(path);
  if (text) return parse_document(path, std::move(text).value(), log);
  const Error& error = text.error();
  if (named_at.file.empty()) {
    log.error({path.string()}, error.what, error.hint);
  } else {
    log.error(named_at, error.where + ": " + error.what, error.hint);
  }
  return nullptr;
}

}  // namespace shoal
