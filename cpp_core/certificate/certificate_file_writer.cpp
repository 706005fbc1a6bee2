// Writes a certificate. The text is made in memory, written beside its destination, and renamed.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "certificate/certificate_file.h"
#include "certificate/certificate_file_names.h"
#include "solids/whole_file.h"

namespace starcell {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "infinity" : "-infinity";
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json point(const Vec3& p) { return Json::array({number(p.x()), number(p.y()), number(p.z())}); }

Json mesh(const StoredMesh& mesh) {
  Json vertices = Json::array(), triangles = Json::array();
  for (const Vec3& p : mesh.vertices) vertices.push_back(point(p));
  for (const Triangle& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2]});
  return {{"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}};
}

Json boxes(const std::vector<Box3>& boxes) {
  Json list = Json::array();
  for (const Box3& box : boxes) list.push_back({{"lower", point(box.min())}, {"upper", point(box.max())}});
  return list;
}

Json node(const StoredNode& node) {
  Json json;
  for (const auto& [kind, name] : certificate_kinds)
    if (kind == node.kind) json["kind"] = name;
  if (is_leaf(node.kind))
    json["index"] = node.leaf;
  else
    json["children"] = node.children;
  return json;
}

// The numbers it was made from and the maps it went through: from these its surfaces follow without rounding.
Json curved_solid(const CurvedSolid& solid) {
  Json parameters = Json::array(), maps = Json::array();
  for (const double x : solid.parameters()) parameters.push_back(number(x));
  for (const Eigen::Matrix4d& map : solid.maps()) {
    Json rows = Json::array();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) rows.push_back(number(map(i, j)));
    maps.push_back(std::move(rows));
  }
  return {{"kind", solid.name()}, {"parameters", std::move(parameters)}, {"maps", std::move(maps)}};
}

Json fields(const Certificate& c) {
  Json tessellated = Json::array(), statistics = Json::object();
  for (const auto& [name, deflection] : c.tessellated)
    tessellated.push_back({{"name", name}, {"deflection", number(deflection)}});
  for (const auto& [name, value] : c.statistics) statistics[name] = number(value);
  return {{"verdict", to_string(c.verdict)},
          {"error_bound", number(c.error_bound)},
          {"requested_error", number(c.requested_error)},
          {"contact_tolerance", number(c.contact_tolerance)},
          {"components", c.components},
          {"genus", c.genus},
          {"euler_characteristic", c.euler_characteristic},
          {"tessellated", std::move(tessellated)},
          {"contacts", boxes(c.contacts)},
          {"unresolved", boxes(c.unresolved)},
          {"statistics", std::move(statistics)}};
}

Json to_json(const CertificateFile& file) {
  Json operands = Json::array(), half_spaces = Json::array(), curved = Json::array(), offsets = Json::array(), sums = Json::array(), expression = Json::array();
  for (const StoredOperand& operand : file.operands)
    operands.push_back({{"name", operand.name}, {"deflection", number(operand.deflection)}, {"mesh", mesh(operand.mesh)}});
  for (const HalfSpace& h : file.half_spaces)
    half_spaces.push_back({{"point", point(h.point)}, {"normal", point(h.normal)}});
  for (const CurvedSolidPtr& solid : file.curved) curved.push_back(curved_solid(*solid));
  for (const StoredOffset& offset : file.offsets) {
    offsets.push_back({{"operand", offset.operand}, {"distance", offset.distance}});
    if (!offset.faces.empty()) offsets.back()["faces"] = offset.faces;
  }
  for (const StoredSum& sum : file.sums) sums.push_back({{"a", sum.a}, {"b", sum.b}, {"erosion", sum.erosion}});
  for (const StoredNode& n : file.expression) expression.push_back(node(n));
  return {{"format", certificate_format},
          {"version", certificate_version},
          {"certificate", fields(file.certificate)},
          {"options", {{"error", number(file.error)}, {"contact", number(file.contact)}}},
          {"expression", std::move(expression)},
          {"half_spaces", std::move(half_spaces)},
          {"curved", std::move(curved)},
          {"offsets", std::move(offsets)},
          {"sums", std::move(sums)},
          {"operands", std::move(operands)},
          {"result", mesh(file.result)}};
}

class Storing {
 public:
  explicit Storing(CertificateFile& file) : file_(file) {}

  std::uint32_t store(const Expression& e) {
    StoredNode node{e.kind(), 0, {}};
    if (e.kind() == Expression::Kind::polyhedron)
      node.leaf = operand(e.polyhedron());
    else if (e.kind() == Expression::Kind::half_space) {
      node.leaf = static_cast<std::uint32_t>(file_.half_spaces.size());
      file_.half_spaces.push_back(e.half_space());
    } else if (e.kind() == Expression::Kind::curved) {
      const auto [place, is_new] = curved_.emplace(e.curved().get(), static_cast<std::uint32_t>(file_.curved.size()));
      if (is_new) file_.curved.push_back(e.curved());
      node.leaf = place->second;
    } else if (e.kind() == Expression::Kind::offset) {
      node.leaf = static_cast<std::uint32_t>(file_.offsets.size());
      file_.offsets.push_back({operand(e.offset()->solid()), e.offset()->distance(), e.offset()->faces()});
    } else if (e.kind() == Expression::Kind::sum) {
      node.leaf = static_cast<std::uint32_t>(file_.sums.size());
      file_.sums.push_back({operand(e.sum()->a()), operand(e.sum()->b()), e.sum()->kind() == SumSolid::Kind::erosion});
    } else {
      for (const Expression& child : e.operands()) node.children.push_back(store(child));
    }
    file_.expression.push_back(std::move(node));
    return static_cast<std::uint32_t>(file_.expression.size() - 1);
  }

 private:
  std::uint32_t operand(const PolyhedronPtr& solid) {
    const auto [place, is_new] = known_.emplace(solid.get(), static_cast<std::uint32_t>(file_.operands.size()));
    if (is_new)
      file_.operands.push_back(
          {solid->provenance().name, solid->provenance().proved_deflection(), {solid->vertices(), solid->triangles()}});
    return place->second;
  }

  CertificateFile& file_;
  std::map<const Polyhedron*, std::uint32_t> known_;
  std::map<const CurvedSolid*, std::uint32_t> curved_;
};

}  // namespace

void store_expression(const Expression& expression, CertificateFile& file) { Storing(file).store(expression); }

void write_certificate(const std::filesystem::path& path, const CertificateFile& file) {
  // An operand's name may be any bytes; what is not UTF-8 in it is replaced.
  write_whole_file(path, to_json(file).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace starcell
