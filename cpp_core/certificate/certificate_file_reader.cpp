// Reads a certificate. Every value is looked at before it is used: a file can hold anything.
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "certificate/certificate_file.h"
#include "certificate/certificate_file_names.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using Json = nlohmann::json;

/// A value of the file together with its place in it, such as "result.triangles[7]", for the messages.
struct Value {
  const Json& json;
  std::string place;

  [[noreturn]] void fail(const std::string& what) const { throw FileError("'" + place + "' " + what); }

  Value operator[](const char* key) const {
    const std::string inner = place.empty() ? key : place + "." + key;
    if (!json.is_object() || !json.contains(key)) Value{json, inner}.fail("is missing");
    return {json.at(key), inner};
  }

  Value at(std::size_t k) const { return {json[k], place + "[" + std::to_string(k) + "]"}; }

  std::size_t size() const {
    if (!json.is_array()) fail("is no list");
    return json.size();
  }

  std::string text() const {
    if (!json.is_string()) fail("is no text");
    return json.get<std::string>();
  }

  double number() const {
    if (json == "infinity") return std::numeric_limits<double>::infinity();
    if (json == "-infinity") return -std::numeric_limits<double>::infinity();
    if (json == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (!json.is_number()) fail("is no number");
    return json.get<double>();
  }

  double length() const {
    const double value = number();
    if (!(value >= 0)) fail("is no length: it must not be negative");
    return value;
  }

  double finite() const {
    const double value = number();
    if (!std::isfinite(value)) fail("is not finite");
    return value;
  }

  int integer() const {
    if (!json.is_number_integer()) fail("is no integer");
    const bool fits = json.is_number_unsigned() ? json.get<std::uint64_t>() <= std::numeric_limits<int>::max()
                                                : json.get<std::int64_t>() >= std::numeric_limits<int>::min();
    if (!fits) fail("is out of range");
    return json.get<int>();
  }

  std::uint32_t index(std::size_t end) const {
    if (!json.is_number_unsigned()) fail("is no index");
    const auto value = json.get<std::uint64_t>();
    if (value >= end || value > std::numeric_limits<std::uint32_t>::max())
      fail("is " + std::to_string(value) + ", but there are only " + std::to_string(end));
    return static_cast<std::uint32_t>(value);
  }

  std::optional<double> optional_length() const { return json.is_null() ? std::nullopt : std::optional<double>(length()); }

  Vec3 point() const {
    if (size() != 3) fail("is no point: it needs three numbers");
    return {at(0).finite(), at(1).finite(), at(2).finite()};
  }
};

StoredMesh read_mesh(const Value& value) {
  StoredMesh mesh;
  const Value vertices = value["vertices"], triangles = value["triangles"];
  for (std::size_t k = 0; k < vertices.size(); ++k) mesh.vertices.push_back(vertices.at(k).point());
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const Value corners = triangles.at(k);
    if (corners.size() != 3) corners.fail("is no triangle: it needs three indices");
    Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = corners.at(c).index(mesh.vertices.size());
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::vector<Box3> read_boxes(const Value& value) {
  std::vector<Box3> boxes;
  for (std::size_t k = 0; k < value.size(); ++k)
    boxes.emplace_back(value.at(k)["lower"].point(), value.at(k)["upper"].point());
  return boxes;
}

StoredNode read_node(const Value& value, const CertificateFile& file) {
  StoredNode node;
  const std::string name = value["kind"].text();
  bool known = false;
  for (const auto& [kind, word] : certificate_kinds)
    if (name == word) node.kind = kind, known = true;
  if (!known) value["kind"].fail("is '" + name + "', which is no kind of expression");
  if (is_leaf(node.kind)) {
    node.leaf = value["index"].index(node.kind == Expression::Kind::polyhedron   ? file.operands.size()
                                     : node.kind == Expression::Kind::half_space ? file.half_spaces.size()
                                     : node.kind == Expression::Kind::curved     ? file.curved.size()
                                     : node.kind == Expression::Kind::offset     ? file.offsets.size()
                                                                                 : file.sums.size());
    return node;
  }
  const Value children = value["children"];
  for (std::size_t k = 0; k < children.size(); ++k) node.children.push_back(children.at(k).index(file.expression.size()));
  if (node.children.empty()) children.fail("is empty");
  if (node.kind == Expression::Kind::complement && node.children.size() != 1) children.fail("must be one node");
  return node;
}

CurvedSolidPtr read_curved(const Value& value) {
  const std::string name = value["kind"].text();
  const Value parameters = value["parameters"], maps = value["maps"];
  std::vector<double> numbers;
  for (std::size_t k = 0; k < parameters.size(); ++k) numbers.push_back(parameters.at(k).finite());
  std::vector<Eigen::Matrix4d> matrices;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const Value rows = maps.at(k);
    if (rows.size() != 12) rows.fail("is no map: it needs twelve numbers");
    Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 12; ++i) map(i / 4, i % 4) = rows.at(static_cast<std::size_t>(i)).finite();
    matrices.push_back(map);
  }
  for (const CurvedSolid::Kind kind : curved_kinds) {
    if (name != CurvedSolid::name_of(kind)) continue;
    try {
      return CurvedSolid::restored(kind, numbers, matrices);
    } catch (const std::invalid_argument& error) {
      value.fail(std::string("is no ") + name + ": " + error.what());
    }
  }
  value["kind"].fail("is '" + name + "', which is no kind of curved solid");
}

Verdict read_verdict(const Value& value) {
  const std::string name = value.text();
  for (const Verdict verdict : certificate_verdicts)
    if (name == to_string(verdict)) return verdict;
  value.fail("is '" + name + "', which is no verdict");
}

Certificate read_fields(const Value& value) {
  Certificate c;
  c.verdict = read_verdict(value["verdict"]);
  c.error_bound = value["error_bound"].length();
  c.requested_error = value["requested_error"].length();
  c.contact_tolerance = value["contact_tolerance"].length();
  c.components = value["components"].integer();
  const Value genus = value["genus"], tessellated = value["tessellated"], statistics = value["statistics"];
  for (std::size_t k = 0; k < genus.size(); ++k) c.genus.push_back(genus.at(k).integer());
  c.euler_characteristic = value["euler_characteristic"].integer();
  for (std::size_t k = 0; k < tessellated.size(); ++k)
    c.tessellated.emplace_back(tessellated.at(k)["name"].text(), tessellated.at(k)["deflection"].length());
  c.contacts = read_boxes(value["contacts"]);
  c.unresolved = read_boxes(value["unresolved"]);
  if (!statistics.json.is_object()) statistics.fail("is no object");
  for (const auto& [name, number] : statistics.json.items())
    c.statistics[name] = Value{number, "statistics." + name}.number();
  return c;
}

CertificateFile read_file(const Value& root) {
  if (!root.json.is_object() || !root.json.contains("format") || root.json["format"] != certificate_format)
    throw FileError("it is no StarCell certificate");
  if (root["version"].integer() != certificate_version)
    throw FileError("its version is " + std::to_string(root["version"].integer()) + "; this program reads version " +
                    std::to_string(certificate_version));
  CertificateFile file;
  const Value operands = root["operands"], half_spaces = root["half_spaces"], expression = root["expression"];
  for (std::size_t k = 0; k < operands.size(); ++k)
    file.operands.push_back(
        {operands.at(k)["name"].text(), operands.at(k)["deflection"].length(), read_mesh(operands.at(k)["mesh"])});
  for (std::size_t k = 0; k < half_spaces.size(); ++k) {
    file.half_spaces.push_back({half_spaces.at(k)["point"].point(), half_spaces.at(k)["normal"].point()});
    if (file.half_spaces.back().normal.isZero(0.0)) half_spaces.at(k)["normal"].fail("is zero");
  }
  if (root.json.contains("curved")) {
    const Value curved = root["curved"];
    for (std::size_t k = 0; k < curved.size(); ++k) file.curved.push_back(read_curved(curved.at(k)));
  }
  if (root.json.contains("offsets")) {
    const Value offsets = root["offsets"];
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      file.offsets.push_back({offsets.at(k)["operand"].index(file.operands.size()), offsets.at(k)["distance"].number(), {}});
      StoredOffset& offset = file.offsets.back();
      if (offsets.at(k).json.contains("faces")) {
        const Value faces = offsets.at(k)["faces"];
        for (std::size_t i = 0; i < faces.size(); ++i)
          offset.faces.push_back(static_cast<std::uint32_t>(faces.at(i).index(file.operands[offset.operand].mesh.triangles.size())));
      }
      if (!std::isfinite(file.offsets.back().distance) || file.offsets.back().distance == 0) offsets.at(k)["distance"].fail("is no distance");
    }
  }
  if (root.json.contains("sums")) {
    const Value sums = root["sums"];
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const Value erosion = sums.at(k)["erosion"];
      if (!erosion.json.is_boolean()) erosion.fail("is neither true nor false");
      file.sums.push_back({sums.at(k)["a"].index(file.operands.size()), sums.at(k)["b"].index(file.operands.size()), erosion.json.get<bool>()});
    }
  }
  for (std::size_t k = 0; k < expression.size(); ++k) file.expression.push_back(read_node(expression.at(k), file));
  file.error = root["options"]["error"].optional_length();
  file.contact = root["options"]["contact"].optional_length();
  file.result = read_mesh(root["result"]);
  file.certificate = read_fields(root["certificate"]);
  return file;
}

}  // namespace

CertificateFile read_certificate(const std::filesystem::path& path) {
  const std::string name = "Cannot read '" + path.string() + "': ";
  std::ifstream stream(path, std::ios::binary);
  std::error_code problem;
  if (!stream || std::filesystem::is_directory(path, problem)) throw FileError(name + "there is no readable file.");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    const Json json = Json::parse(text);
    return read_file(Value{json, ""});
  } catch (const Json::exception& error) {
    throw FileError(name + "it is no JSON text: " + error.what() + ".");
  } catch (const FileError& error) {
    throw FileError(name + error.what() + ".");
  }
}

}  // namespace starcell
