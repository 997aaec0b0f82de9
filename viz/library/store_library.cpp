#include "library/store_library.h"

#include <sqlite3.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/mat3x3.hpp>
#include <map>
#include <memory>
#include <sstream>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "library/painted_pixels.h"
#include "library/table_library.h"

namespace shoal::viz {
namespace {

static_assert(std::endian::native == std::endian::little, "the store's numbers are little-endian");

// engine/batch/store_schema.h says what these are, and describes all tables.
constexpr std::int64_t kApplicationId = 0x73686f6c;
constexpr std::int64_t kVersion = 4;

constexpr int kBusyTimeoutMs = 30'000;  // while a run writes

constexpr const char* kSelectItems =
    "SELECT name, status, error, input_path, format, width, height, pixel_count, nonfinite_count,"
    " negative_count, clamped_count, minimum_r, minimum_g, minimum_b, maximum_r, maximum_g,"
    " maximum_b, mean_r, mean_g, mean_b, warnings, degree, radiance,"
    " (SELECT path FROM outputs WHERE outputs.item = id AND kind = 'picture'), parameters"
    " FROM items LEFT JOIN projections ON projections.item = id ORDER BY name";

constexpr const char* kSelectQuality =
    "SELECT name, variant, rms_error, max_error, minimum_irradiance, negative_fraction, contrast,"
    " directionality, key_temperature, fill_temperature FROM quality JOIN items ON items.id = item";

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close_v2)>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

// Columns of a statement's current row.
class Row {
 public:
  explicit Row(sqlite3_stmt* statement) : statement_(statement) {}

  [[nodiscard]] std::int64_t integer(int column) const {
    return sqlite3_column_int64(statement_, column);
  }
  [[nodiscard]] std::optional<double> known(int column) const {
    if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return std::nullopt;
    return sqlite3_column_double(statement_, column);
  }
  [[nodiscard]] std::array<double, 3> triple(int column) const {
    return {sqlite3_column_double(statement_, column),
            sqlite3_column_double(statement_, column + 1),
            sqlite3_column_double(statement_, column + 2)};
  }
  [[nodiscard]] std::string text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
    return bytes ? std::string(bytes, size) : std::string();
  }
  [[nodiscard]] std::string_view blob(int column) const {
    const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
    return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
  }

 private:
  sqlite3_stmt* statement_;
};

Error unreadable(const std::filesystem::path& path, sqlite3* database, int code) {
  const int primary = code & 0xff;
  const bool damaged = primary == SQLITE_CORRUPT || primary == SQLITE_NOTADB;
  const char* reason = database ? sqlite3_errmsg(database) : sqlite3_errstr(code);
  return Error{damaged ? ErrorCode::malformed : ErrorCode::unreadable,
               std::string("the store cannot be read: ") + reason, path.string(),
               damaged ? "delete it and run `shoal run` again" : ""};
}

Status query(const std::filesystem::path& path, sqlite3* database, const char* sql,
             const std::function<Status(const Row&)>& take) {
  sqlite3_stmt* prepared = nullptr;
  int code = sqlite3_prepare_v2(database, sql, -1, &prepared, nullptr);
  const Statement statement(prepared, sqlite3_finalize);
  while (code == SQLITE_OK || code == SQLITE_ROW) {
    code = sqlite3_step(prepared);
    if (code == SQLITE_ROW) SHOAL_RETURN_IF_ERROR(take(Row(prepared)));
  }
  return code == SQLITE_DONE ? Status() : Status(unreadable(path, database, code));
}

Status expect_pragma(const std::filesystem::path& path, sqlite3* database, const char* pragma,
                     std::int64_t expected, const Error& error) {
  return query(path, database, pragma, [&](const Row& row) {
    return row.integer(0) == expected ? Status() : Status(error);
  });
}

Result<Database> open_store(const std::filesystem::path& path) {
  sqlite3* handle = nullptr;
  // For writing, too: what a killed run began has to be taken back before anything can be read.
  const int code = sqlite3_open_v2(path.c_str(), &handle, SQLITE_OPEN_READWRITE, nullptr);
  Database database(handle, sqlite3_close_v2);
  if (code != SQLITE_OK) return unreadable(path, handle, code);
  sqlite3_busy_timeout(handle, kBusyTimeoutMs);
  SHOAL_RETURN_IF_ERROR(expect_pragma(path, handle, "PRAGMA application_id", kApplicationId,
                                      Error{ErrorCode::malformed, "is not a store of shoal",
                                            path.string(), "`shoal run MANIFEST` makes one"}));
  SHOAL_RETURN_IF_ERROR(expect_pragma(
      path, handle, "PRAGMA user_version", kVersion,
      Error{ErrorCode::unsupported, "the store is of another version of shoal", path.string(),
            "use the shoal-viz that came with the shoal that wrote it"}));
  return database;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

Result<Coefficients> radiance_from(const Row& row, const std::string& name) {
  const std::int64_t degree = row.integer(21);
  std::string_view blob = row.blob(22);
  const bool known = degree >= 0 && degree <= kMaxDegree;
  Coefficients coefficients(known ? static_cast<int>(degree) : 0);
  const std::size_t size = coefficients.channels[0].size() * sizeof(double);
  if (!known || blob.size() != kChannelCount * size) {
    return Error{ErrorCode::malformed, "the store is damaged: the coefficients are cut off", name,
                 "delete it and run `shoal run` again"};
  }
  for (auto& channel : coefficients.channels) {
    std::memcpy(channel.data(), blob.data(), size);
    blob.remove_prefix(size);
  }
  return coefficients;
}

PixelFigures figures_of(const Row& row) {
  PixelFigures figures;
  figures.format = row.text(4);
  figures.width = static_cast<int>(row.integer(5));
  figures.height = static_cast<int>(row.integer(6));
  figures.pixel_count = row.integer(7);
  figures.nonfinite_count = row.integer(8);
  figures.negative_count = row.integer(9);
  figures.clamped_count = row.integer(10);
  figures.minimum = row.triple(11);
  figures.maximum = row.triple(14);
  figures.mean = row.triple(17);
  return figures;
}

// The pixels of a panorama: its file, or what was painted of it, below the store's folder.
std::filesystem::path pixels_of(const Row& row, const std::filesystem::path& folder) {
  const std::string file = row.text(3);
  const std::string picture = row.text(23);
  return file.empty() && !picture.empty() ? folder / picture : std::filesystem::path(file);
}

// The format ends with the layout, behind a comma, where that is not equirect.
Layout layout_of(const std::string& format) {
  const std::size_t comma = format.rfind(", ");
  if (comma == format.npos) return Layout::equirect;
  const Result<Layout> layout = parse_layout(std::string_view(format).substr(comma + 2));
  return layout ? *layout : Layout::equirect;
}

Status take_item(const Row& row, const std::filesystem::path& folder, Library& library) {
  const std::string name = row.text(0);
  const std::string status = row.text(1);
  if (status == "failed") {
    library.failed.push_back({name, row.text(2), row.text(3)});
    return {};
  }
  if (status != "done") {
    library.failed.push_back({name, "its processing was broken off; `shoal run` goes on with it"});
    return {};
  }
  Panorama panorama;
  panorama.name = name;
  panorama.file = pixels_of(row, folder);
  panorama.layout = layout_of(row.text(4));
  if (panorama.file.empty()) panorama.recipe = recipe_of(row.text(24));
  SHOAL_ASSIGN_OR_RETURN(radiance, radiance_from(row, name));
  panorama.coefficients = std::move(radiance);
  const bool has_pixels = row.integer(7) > 0;  // lights alone have none
  if (has_pixels) panorama.pixels = figures_of(row);
  panorama.warnings = lines_of(row.text(20));
  library.panoramas.push_back(std::move(panorama));
  return {};
}

// The library's panoramas are in the order of their names, as the tags are.
Status take_tag(const Row& row, Library& library) {
  const std::string name = row.text(0);
  const auto found = std::ranges::lower_bound(library.panoramas, name, {}, &Panorama::name);
  if (found != library.panoramas.end() && found->name == name) found->tags.push_back(row.text(1));
  return {};
}

// By full name; a variant called plain is the panorama itself.
Status take_quality(const Row& row, std::unordered_map<std::string, QualityFigures>& quality) {
  const std::string variant = row.text(1);
  const std::string name = variant == kPlainVariant ? row.text(0) : row.text(0) + "." + variant;
  quality[name] = {.rms_error = row.known(2),
                   .max_error = row.known(3),
                   .minimum_irradiance = row.known(4),
                   .negative_fraction = row.known(5).value_or(0.0),
                   .contrast = row.known(6),
                   .directionality = row.known(7),
                   .key_temperature = row.known(8),
                   .fill_temperature = row.known(9)};
  return {};
}

Status add_quality(const std::filesystem::path& store, sqlite3* database, Library& library) {
  std::unordered_map<std::string, QualityFigures> quality;
  SHOAL_RETURN_IF_ERROR(query(store, database, kSelectQuality,
                              [&](const Row& row) { return take_quality(row, quality); }));
  for (Panorama& panorama : library.panoramas) {
    const auto found = quality.find(full_name(panorama));
    if (found != quality.end()) panorama.quality = found->second;
  }
  return {};
}

// What the store says of a panorama in a variant. Where it says nothing: the light of the pixels.
struct VariantFacts {
  Frame frame;  // of a table
  LightChange change;
};
using FactsByName = std::map<std::pair<std::string, std::string>, VariantFacts>;

// Nine numbers, row after row.
Result<glm::dmat3> matrix_from(const std::string& text) {
  std::istringstream numbers(text);
  glm::dmat3 matrix(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) numbers >> matrix[column][row];
  }
  if (numbers) return matrix;
  return Error{ErrorCode::malformed, "the store is damaged: not a matrix", text,
               "delete it and run `shoal run` again"};
}

Result<FactsByName> facts_in(const std::filesystem::path& store, sqlite3* database) {
  FactsByName facts;
  const auto take = [&](const Row& row) -> Status {
    VariantFacts fact;
    SHOAL_ASSIGN_OR_RETURN(frame, parse_frame(row.text(2)));
    SHOAL_ASSIGN_OR_RETURN(colour, matrix_from(row.text(3)));
    SHOAL_ASSIGN_OR_RETURN(turn, matrix_from(row.text(4)));
    fact.frame = frame;
    fact.change = {colour, turn, row.integer(5) != 0};
    facts[{row.text(0), row.text(1)}] = fact;
    return {};
  };
  SHOAL_RETURN_IF_ERROR(
      query(store, database,
            "SELECT panorama, variant, frame, colour, turn, is_whole FROM variants", take));
  return facts;
}

// The run's table. JSON tells its frames itself; of CSV the store does.
Result<std::vector<CoefficientRecord>> table_beside(const std::filesystem::path& store,
                                                    const FactsByName& facts) {
  std::error_code code;
  const auto json = store.parent_path() / kJsonTableName;
  if (std::filesystem::exists(json, code)) return read_table(json);
  const auto csv = store.parent_path() / kCsvTableName;
  if (!std::filesystem::exists(csv, code)) return std::vector<CoefficientRecord>();
  SHOAL_ASSIGN_OR_RETURN(records, read_table(csv));
  for (CoefficientRecord& record : records) {
    const auto fact = facts.find({record.panorama, record.variant});
    if (fact != facts.end()) record.frame = fact->second.frame;
  }
  return records;
}

// Whether the table tells another light than the one that the pixels were projected to.
bool tells_other_light(const Panorama& told, const Panorama& projected) {
  const Coefficients own = apply_quantity(projected.coefficients, told.quantity);
  if (own.degree != told.coefficients.degree) return true;
  constexpr double kRounding = 1e-12;  // of turning to a frame and back
  for (int c = 0; c < kChannelCount; ++c) {
    const double size = std::abs(own.channels[c][0]);
    for (std::size_t i = 0; i < own.channels[c].size(); ++i) {
      if (std::abs(own.channels[c][i] - told.coefficients.channels[c][i]) > kRounding * size) {
        return true;
      }
    }
  }
  return false;
}

// What a manifest asked to be made of the pixels' light; a clamp took some of it away before.
void take_change(const FactsByName& facts, Panorama& panorama) {
  const auto fact = facts.find({panorama.name, variant_of(panorama)});
  panorama.change = fact != facts.end() ? fact->second.change : LightChange{};
  if (panorama.pixels && panorama.pixels->clamped_count > 0) panorama.change.is_whole = false;
}

// The light that was made of it, in place of the one that the pixels hold.
void take_light(Panorama& told, Panorama& panorama) {
  panorama.quantity = told.quantity;
  panorama.coefficients = std::move(told.coefficients);
}

// What the store says of a panorama holds for its variants, but for the coefficients.
void add_variants(std::vector<Panorama> table, const FactsByName& facts, Library& library) {
  std::unordered_map<std::string, std::size_t> stored;
  for (std::size_t i = 0; i < library.panoramas.size(); ++i) {
    stored.emplace(library.panoramas[i].name, i);
  }
  // (position in the table, panorama): each panorama stands before its variants.
  constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> positions(library.panoramas.size(), kNowhere);
  std::vector<std::pair<std::size_t, std::size_t>> plain;  // the same, of other light
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto found = stored.find(table[i].name);
    if (found == stored.end()) continue;
    std::size_t& position = positions[found->second];
    const bool is_first = position == kNowhere;
    position = std::min(position, i);
    Panorama& own = library.panoramas[found->second];
    if (is_first) own.frame = table[i].frame;  // also where the table has its variants alone
    if (table[i].variant.empty()) {
      take_change(facts, own);
      own.frame = table[i].frame;
      own.told = table[i].told;
      if (tells_other_light(table[i], own)) plain.emplace_back(i, found->second);
      continue;
    }
    Panorama variant = own;
    variant.variant = table[i].variant;
    take_change(facts, variant);
    variant.frame = table[i].frame;
    variant.told = table[i].told;
    take_light(table[i], variant);
    library.panoramas.push_back(std::move(variant));
    positions.push_back(i);
  }
  // Not before: a variant begins with what the pixels were projected to.
  for (const auto& [told, own] : plain) take_light(table[told], library.panoramas[own]);
  std::vector<std::size_t> order(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return positions[i]; });
  std::vector<Panorama> sorted;
  for (const std::size_t i : order) sorted.push_back(std::move(library.panoramas[i]));
  library.panoramas = std::move(sorted);
}

}  // namespace

Result<Library> load_store(const std::filesystem::path& store) {
  SHOAL_ASSIGN_OR_RETURN(database, open_store(store));
  Library library;
  SHOAL_RETURN_IF_ERROR(query(store, database.get(), kSelectItems, [&](const Row& row) {
    return take_item(row, store.parent_path(), library);
  }));
  SHOAL_RETURN_IF_ERROR(query(store, database.get(),
                              "SELECT panorama, tag FROM tags ORDER BY panorama, position",
                              [&](const Row& row) { return take_tag(row, library); }));
  SHOAL_ASSIGN_OR_RETURN(facts, facts_in(store, database.get()));
  SHOAL_ASSIGN_OR_RETURN(records, table_beside(store, facts));
  add_variants(panoramas_of(std::move(records)), facts, library);
  SHOAL_RETURN_IF_ERROR(add_quality(store, database.get(), library));
  return library;
}

}  // namespace shoal::viz
