#include "scenes/gltf.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "core/version.h"
#include "library/light.h"
#include "output/text_quoting.h"

namespace shoal::viz {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Where the parts lie in the buffer: floats first, then the indices, so all are aligned to 4.
struct Buffer {
  std::string bytes;
  std::size_t normals = 0;
  std::size_t colours = 0;
  std::size_t indices = 0;
};

template <typename T>
std::size_t append(std::string& bytes, const std::vector<T>& items) {
  const std::size_t offset = bytes.size();
  bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
  return offset;
}

Buffer buffer_of(const GltfModel& model) {
  std::vector<glm::vec3> linear;
  for (const glm::vec3& c : model.colours) {
    linear.emplace_back(srgb_decoded(c.r), srgb_decoded(c.g), srgb_decoded(c.b));
  }
  Buffer buffer;
  append(buffer.bytes, model.mesh.positions);
  buffer.normals = append(buffer.bytes, model.mesh.normals);
  buffer.colours = append(buffer.bytes, linear);
  buffer.indices = append(buffer.bytes, model.mesh.triangles);
  return buffer;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);  // tells any two floats apart
  return text;
}

std::string triple(const glm::vec3& v) {
  return '[' + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ']';
}

// The rotation that takes the frame's up to +y and its centre to +z, as a quaternion x, y, z, w.
std::string rotation_of(const Frame& frame) {
  const glm::vec3 up(direction_of(frame.up));
  const glm::vec3 front(direction_of(frame.center));
  // Rows are what comes to x, y, z.
  const glm::mat3 turn = glm::transpose(glm::mat3(glm::cross(up, front), up, front));
  const glm::quat q = glm::normalize(glm::quat_cast(turn));
  return '[' + number(q.x) + ", " + number(q.y) + ", " + number(q.z) + ", " + number(q.w) + ']';
}

std::string view(std::size_t offset, std::size_t length, int target) {
  return "    {\"buffer\": 0, \"byteOffset\": " + std::to_string(offset) +
         ", \"byteLength\": " + std::to_string(length) + ", \"target\": " + std::to_string(target) +
         '}';
}

std::string accessors_of(const Mesh& mesh) {
  glm::vec3 low = mesh.positions.front();
  glm::vec3 high = low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const std::string vectors =
      "\"componentType\": 5126, \"count\": " + std::to_string(mesh.positions.size()) +
      ", \"type\": \"VEC3\"";
  return "    {\"bufferView\": 0, " + vectors + ", \"min\": " + triple(low) +
         ", \"max\": " + triple(high) + "},\n    {\"bufferView\": 1, " + vectors +
         "},\n    {\"bufferView\": 2, " + vectors +
         "},\n    {\"bufferView\": 3, \"componentType\": 5125, \"count\": " +
         std::to_string(3 * mesh.triangles.size()) + ", \"type\": \"SCALAR\"}";
}

std::string json_of(const GltfModel& model, const Buffer& buffer, const std::string& uri) {
  constexpr int kVertices = 34962;  // ARRAY_BUFFER
  constexpr int kIndices = 34963;   // ELEMENT_ARRAY_BUFFER
  std::string notes;
  for (const auto& [name, value] : model.notes) {
    notes +=
        (notes.empty() ? "" : ",\n") + ("      " + json_quoted(name)) + ": " + json_quoted(value);
  }
  const std::size_t part = buffer.normals;  // positions, normals and colours are equally long
  return "{\n  \"asset\": {\n    \"version\": \"2.0\",\n    \"generator\": \"shoal " +
         std::string(kVersion) + "\",\n    \"extras\": {\n" + notes +
         "\n    }\n  },\n"
         "  \"scene\": 0,\n  \"scenes\": [{\"nodes\": [0]}],\n"
         "  \"nodes\": [{\"mesh\": 0, \"name\": \"lobes\", \"rotation\": " +
         rotation_of(model.frame) +
         "}],\n"
         "  \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1, "
         "\"COLOR_0\": 2}, \"indices\": 3, \"material\": 0}]}],\n"
         "  \"materials\": [{\"pbrMetallicRoughness\": {\"metallicFactor\": 0, "
         "\"roughnessFactor\": 0.7}}],\n"
         "  \"accessors\": [\n" +
         accessors_of(model.mesh) + "\n  ],\n  \"bufferViews\": [\n" + view(0, part, kVertices) +
         ",\n" + view(buffer.normals, part, kVertices) + ",\n" +
         view(buffer.colours, part, kVertices) + ",\n" +
         view(buffer.indices, buffer.bytes.size() - buffer.indices, kIndices) +
         "\n  ],\n  \"buffers\": [{\"byteLength\": " + std::to_string(buffer.bytes.size()) + uri +
         "}]\n}\n";
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < count; ++k) {
      three |= std::uint32_t(static_cast<unsigned char>(bytes[i + k])) << (16 - 8 * k);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[three >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

void append_word(std::string& bytes, std::size_t word) {
  const auto value = static_cast<std::uint32_t>(word);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string gltf_text(const GltfModel& model) {
  const Buffer buffer = buffer_of(model);
  return json_of(model, buffer,
                 ", \"uri\": \"data:application/octet-stream;base64," + base64(buffer.bytes) + '"');
}

std::string glb_text(const GltfModel& model) {
  constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF"
  constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
  constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN"
  const Buffer buffer = buffer_of(model);
  std::string json = json_of(model, buffer, "");
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string bytes;
  append_word(bytes, kMagic);
  append_word(bytes, 2);
  append_word(bytes, 12 + 8 + json.size() + 8 + buffer.bytes.size());
  append_word(bytes, json.size());
  append_word(bytes, kJson);
  bytes += json;
  append_word(bytes, buffer.bytes.size());
  append_word(bytes, kBinary);
  return bytes + buffer.bytes;
}

}  // namespace shoal::viz
