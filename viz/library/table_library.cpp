#include "library/table_library.h"

#include <fmt/format.h>
#include <json/json.h>

#include <fstream>
#include <glm/matrix.hpp>
#include <map>
#include <memory>
#include <system_error>
#include <utility>

#include "core/input_file.h"
#include "sphere/rotation.h"

namespace shoal::viz {
namespace {

Error not_a_table(const std::filesystem::path& path, const std::string& what) {
  return Error{ErrorCode::malformed, what, path.string(),
               "a table written by shoal is read back as it is; was this one edited?"};
}

// Two hexadecimal digits a byte; nothing where it is something else.
std::string bytes_of(const std::string& hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) {
    const std::string pair = hexadecimal.substr(i, 2);
    char* end = nullptr;
    const long value = std::strtol(pair.c_str(), &end, 16);
    if (end != pair.c_str() + 2) return {};
    bytes += static_cast<char>(value);
  }
  return bytes;
}

// A name that is not UTF-8 stands beside itself in hexadecimal.
std::string name_in(const Json::Value& record, const std::string& key) {
  const Json::Value& bytes = record[key + "_hex"];
  return bytes.isString() ? bytes_of(bytes.asString()) : record.get(key, "").asString();
}

Result<Coefficients> coefficients_of(const Json::Value& record) {
  const int degree = record["degree"].asInt();
  const Json::Value& rows = record["coefficients"];
  if (degree < 0 || degree > kMaxDegree ||
      rows.size() != static_cast<Json::ArrayIndex>(coefficient_count(degree))) {
    return Error{ErrorCode::malformed,
                 fmt::format("{} coefficients are not those of a degree {}", rows.size(), degree),
                 "", ""};
  }
  Coefficients coefficients(degree);
  for (Json::ArrayIndex i = 0; i < rows.size(); ++i) {
    for (Json::ArrayIndex c = 0; c < kChannelCount; ++c) {
      coefficients.channels[c][i] = rows[i][c].asDouble();
    }
  }
  return coefficients;
}

Result<CoefficientRecord> record_of(const Json::Value& value) {
  CoefficientRecord record;
  record.panorama = name_in(value, "panorama");
  record.variant = name_in(value, "variant");
  SHOAL_ASSIGN_OR_RETURN(quantity, parse_quantity(value["quantity"].asString()));
  SHOAL_ASSIGN_OR_RETURN(frame, parse_frame(value["frame"].asString()));
  SHOAL_ASSIGN_OR_RETURN(coefficients, coefficients_of(value));
  record.quantity = quantity;
  record.frame = frame;
  record.coefficients = std::move(coefficients);
  return record;
}

Result<std::vector<CoefficientRecord>> records_of(const Json::Value& table) {
  if (!table.isObject() || table["schema"] != "shoal/coefficients") {
    return Error{ErrorCode::malformed, "its \"schema\" is not \"shoal/coefficients\"", "", ""};
  }
  if (table["version"].asInt() != 1) {
    return Error{ErrorCode::unsupported, "a table of another version than 1", "", ""};
  }
  std::vector<CoefficientRecord> records;
  for (const Json::Value& value : table["records"]) {
    auto record = record_of(value);
    if (!record) {
      return Error{ErrorCode::malformed,
                   fmt::format("record {}: {}", records.size() + 1, record.error().what), "", ""};
    }
    records.push_back(std::move(*record));
  }
  return records;
}

// JsonCpp throws where a value is of another kind than it is asked for.
Result<std::vector<CoefficientRecord>> read_json_table(const std::filesystem::path& path) {
  SHOAL_ASSIGN_OR_RETURN(file, InputFile::open(path));  // says why it cannot be opened
  std::ifstream stream(path, std::ios::binary);
  try {
    Json::Value table;
    std::string complaint;
    if (!Json::parseFromStream(Json::CharReaderBuilder(), stream, &table, &complaint)) {
      return not_a_table(path, "not JSON: " + complaint.substr(0, complaint.find('\n')));
    }
    auto records = records_of(table);
    if (!records) return not_a_table(path, records.error().what);
    return records;
  } catch (const Json::Exception& exception) {
    return not_a_table(path, exception.what());
  }
}

// Only the native frame leaves the bits as they are.
Coefficients in_native_frame(const CoefficientRecord& record) {
  if (record.frame == Frame{}) return record.coefficients;
  return rotate(record.coefficients, glm::transpose(native_to_frame(record.frame)));
}

// Radiance says most, and irradiance and irradiance over pi the same.
bool says_more(Quantity quantity, Quantity than) { return quantity < than; }

}  // namespace

Result<std::vector<CoefficientRecord>> read_table(const std::filesystem::path& path) {
  const auto extension = path.extension();
  if (extension == ".json") return read_json_table(path);
  if (extension == ".csv") return read_csv_table(path);
  return Error{ErrorCode::unsupported, "is not a CSV or JSON table", path.string(),
               "`shoal run --format csv` writes one from the same store"};
}

std::vector<Panorama> panoramas_of(std::vector<CoefficientRecord> records) {
  std::vector<Panorama> panoramas;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (CoefficientRecord& record : records) {
    if (record.variant == kPlainVariant) record.variant.clear();
    const auto [place, is_new] =
        places.try_emplace({record.panorama, record.variant}, panoramas.size());
    if (is_new) {
      Panorama& panorama = panoramas.emplace_back();
      panorama.name = record.panorama;
      panorama.variant = record.variant;
      panorama.frame = record.frame;
      panorama.change.is_whole = record.variant.empty();  // a table does not say from what
      std::error_code code;
      if (std::filesystem::is_regular_file(record.panorama, code)) panorama.file = record.panorama;
    }
    Panorama& panorama = panoramas[place->second];
    if (is_new || says_more(record.quantity, panorama.quantity)) {
      panorama.quantity = record.quantity;
      panorama.coefficients = in_native_frame(record);
    }
    panorama.told[record.quantity] = std::move(record.coefficients);
  }
  return panoramas;
}

}  // namespace shoal::viz
