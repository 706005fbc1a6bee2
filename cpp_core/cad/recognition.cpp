#include "cad/recognition.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <numbers>
#include <set>

#include "cad/consistency.h"

namespace starcell::cad {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double same_direction = 1e-9;   ///< sine of the angle between directions that count as one
constexpr double same_length = 1e-9;      ///< of the solid's size
constexpr double small_tolerance = 1e-6;  ///< of the solid's size: how far its faces may be apart by their own account
constexpr double same_volume = 1e-6;      ///< relative
constexpr double largest_size = 1e10;     ///< beyond, coordinates have no digits left for the details

Vec3 vec(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

/// A plane or an elementary surface, placed: with location, mirroring and scaling applied.
struct Surface {
  GeomAbs_SurfaceType type = GeomAbs_OtherSurface;
  Vec3 origin = Vec3::Zero(), axis = Vec3::UnitZ();
  double radius = 0;  ///< of a cone at the origin; of a torus's circle
  double minor = 0;   ///< of a torus's tube
  double slope = 0;   ///< of a cone: growth of its radius along the axis

  static Surface of(const TopoDS_Face& face) {
    const BRepAdaptor_Surface adaptor(face, Standard_False);
    Surface s;
    s.type = adaptor.GetType();
    const auto place = [&](const gp_Ax3& frame) {
      s.origin = vec(frame.Location().XYZ());
      s.axis = vec(frame.Direction().XYZ());
    };
    switch (s.type) {
      case GeomAbs_Plane: place(adaptor.Plane().Position()); break;
      case GeomAbs_Sphere:
        place(adaptor.Sphere().Position());
        s.radius = adaptor.Sphere().Radius();
        break;
      case GeomAbs_Cylinder:
        place(adaptor.Cylinder().Position());
        s.radius = adaptor.Cylinder().Radius();
        break;
      case GeomAbs_Cone:
        place(adaptor.Cone().Position());
        s.radius = adaptor.Cone().RefRadius();
        s.slope = std::tan(adaptor.Cone().SemiAngle());
        break;
      case GeomAbs_Torus:
        place(adaptor.Torus().Position());
        s.radius = adaptor.Torus().MajorRadius();
        s.minor = adaptor.Torus().MinorRadius();
        break;
      default: s.type = GeomAbs_OtherSurface;
    }
    return s;
  }

  double height(const Vec3& p) const { return axis.dot(p - origin); }
  Vec3 at(double height) const { return origin + height * axis; }
  double radius_at(double height) const { return radius + slope * height; }
  bool is_parallel(const Vec3& direction) const { return axis.cross(direction).norm() <= same_direction; }

  bool is(const Surface& other, double near) const {
    if (type != other.type || std::abs(minor - other.minor) > near) return false;
    const double h = height(other.origin);
    switch (type) {
      case GeomAbs_Sphere: return (other.origin - origin).norm() <= near && std::abs(radius - other.radius) <= near;
      case GeomAbs_Plane: return is_parallel(other.axis) && std::abs(h) <= near;
      case GeomAbs_Torus:
        if (std::abs(h) > near) return false;
        break;
      case GeomAbs_Cone:
        if (std::abs(slope * axis.dot(other.axis) - other.slope) > same_direction * (1 + slope * slope)) return false;
        break;
      case GeomAbs_Cylinder: break;
      default: return false;
    }
    return is_parallel(other.axis) && (other.origin - at(h)).norm() <= near &&
           std::abs(radius_at(h) - other.radius) <= near;
  }
};

/// Gathers the surfaces that the faces lie on, each once: one curved, and the planes that end it.
class Recognition {
 public:
  explicit Recognition(const TopoDS_Solid& solid) : solid_(solid) {}

  CurvedSolidPtr run() {
    if (!measure() || !gather_faces() || !check_planes() || !check_edges()) return nullptr;
    double volume = 0;
    CurvedSolidPtr candidate = make(volume);
    if (!candidate || !inconsistency(solid_, size_).empty()) return nullptr;
    GProp_GProps properties(centre_);
    BRepGProp::VolumeProperties(solid_, properties);
    return std::abs(std::abs(properties.Mass()) - volume) <= same_volume * volume ? candidate : nullptr;
  }

 private:
  bool measure() {
    Bnd_Box box;
    BRepBndLib::Add(solid_, box, Standard_False);
    if (box.IsVoid() || box.IsOpen()) return false;
    size_ = std::sqrt(box.SquareExtent());
    centre_ = gp_Pnt((box.CornerMin().XYZ() + box.CornerMax().XYZ()) / 2);
    const Vec3 low = vec(box.CornerMin().XYZ()), high = vec(box.CornerMax().XYZ());
    // Far from the origin coordinates have fewer digits than that.
    near_ = same_length * size_ + 1e-15 * std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    // OpenCASCADE states its smallest tolerance of everything, however small; only more than that says something.
    const double allowed = std::max(small_tolerance * size_, 1.001 * Precision::Confusion());
    for (const TopAbs_ShapeEnum kind : {TopAbs_FACE, TopAbs_EDGE, TopAbs_VERTEX})
      if (!(BRep_Tool::MaxTolerance(solid_, kind) <= allowed)) return false;
    return size_ > 0 && size_ < largest_size;
  }

  bool gather_faces() {
    int shells = 0;
    for (TopExp_Explorer walk(solid_, TopAbs_SHELL); walk.More(); walk.Next()) ++shells;
    if (shells != 1) return false;
    for (TopExp_Explorer walk(solid_, TopAbs_FACE); walk.More(); walk.Next()) {
      const TopoDS_Shape& face = walk.Current();
      if (face.Orientation() != TopAbs_FORWARD && face.Orientation() != TopAbs_REVERSED) return false;
      if (faces_.Contains(face)) return false;
      faces_.Add(face);
      const Surface surface = Surface::of(TopoDS::Face(face));
      if (surface.type == GeomAbs_OtherSurface) return false;
      surface_of_.push_back(number_of(surface));
      if (surfaces_.size() > 3) return false;
    }
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (surfaces_[i].type != GeomAbs_Plane) {
        if (curved_ >= 0) return false;
        curved_ = static_cast<int>(i);
      }
    return curved_ >= 0;
  }

  int number_of(const Surface& surface) {
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (surfaces_[i].is(surface, near_)) return static_cast<int>(i);
    surfaces_.push_back(surface);
    return static_cast<int>(surfaces_.size()) - 1;
  }

  const Surface& curved() const { return surfaces_[static_cast<std::size_t>(curved_)]; }

  bool check_planes() {
    const std::size_t planes = surfaces_.size() - 1;
    switch (curved().type) {
      case GeomAbs_Sphere:
      case GeomAbs_Torus: return planes == 0;
      case GeomAbs_Cylinder:
        if (planes != 2) return false;
        break;
      case GeomAbs_Cone:
        if (planes != 1 && planes != 2) return false;
        break;
      default: return false;
    }
    for (const Surface& plane : surfaces_) {
      if (plane.type != GeomAbs_Plane) continue;
      if (!curved().is_parallel(plane.axis)) return false;
      ends_.insert(curved().height(plane.origin));
    }
    return true;
  }

  bool check_edges() {
    BRepLib::BuildCurves3d(solid_);
    TopTools_IndexedMapOfShape edges;
    std::vector<std::set<int>> sides;
    for (int f = 1; f <= faces_.Extent(); ++f)
      for (TopExp_Explorer walk(faces_(f), TopAbs_EDGE); walk.More(); walk.Next()) {
        if (BRep_Tool::Degenerated(TopoDS::Edge(walk.Current()))) continue;
        const auto index = static_cast<std::size_t>(edges.Add(walk.Current()));
        sides.resize(std::max(sides.size(), index));
        sides[index - 1].insert(surface_of_[static_cast<std::size_t>(f) - 1]);
      }
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (sides[i].size() == 1) continue;
      if (sides[i].size() > 2 || !sides[i].contains(curved_)) return false;
      const int plane = *sides[i].begin() == curved_ ? *sides[i].rbegin() : *sides[i].begin();
      if (!is_rim(TopoDS::Edge(edges(static_cast<int>(i) + 1)), surfaces_[static_cast<std::size_t>(plane)])) return false;
    }
    return true;
  }

  /// Whether the edge is (a part of) the circle in which the curved surface meets the plane.
  bool is_rim(const TopoDS_Edge& edge, const Surface& plane) const {
    const BRepAdaptor_Curve curve(edge);
    if (curve.GetType() != GeomAbs_Circle) return false;
    const gp_Circ circle = curve.Circle();
    const double height = curved().height(plane.origin);
    return curved().is_parallel(vec(circle.Axis().Direction().XYZ())) &&
           (vec(circle.Location().XYZ()) - curved().at(height)).norm() <= near_ &&
           std::abs(circle.Radius() - std::abs(curved().radius_at(height))) <= near_;
  }

  CurvedSolidPtr make(double& volume) const {
    const Surface& s = curved();
    if (!(s.radius >= 0) || !s.origin.allFinite()) return nullptr;
    switch (s.type) {
      case GeomAbs_Sphere:
        volume = 4 * pi * s.radius * s.radius * s.radius / 3;
        return s.radius > near_ ? CurvedSolid::sphere(s.origin, s.radius) : nullptr;
      case GeomAbs_Torus:
        volume = 2 * pi * pi * s.radius * s.minor * s.minor;
        return s.minor > near_ && s.minor < s.radius - near_ ? CurvedSolid::torus(s.origin, s.axis, s.radius, s.minor) : nullptr;
      case GeomAbs_Cylinder: {
        const double low = *ends_.begin(), height = *ends_.rbegin() - low;
        volume = pi * s.radius * s.radius * height;
        return s.radius > near_ && height > near_ ? CurvedSolid::cylinder(s.at(low), s.axis, s.radius, height) : nullptr;
      }
      case GeomAbs_Cone: return make_cone(volume);
      default: return nullptr;
    }
  }

  CurvedSolidPtr make_cone(double& volume) const {
    const Surface& s = curved();
    std::set<double> ends = ends_;
    const double tip = -s.radius / s.slope;
    if (!std::isfinite(tip)) return nullptr;
    if (ends.size() == 1) ends.insert(tip);
    const double low = *ends.begin(), high = *ends.rbegin(), height = high - low;
    const double at_low = low == tip ? 0 : s.radius_at(low), at_high = high == tip ? 0 : s.radius_at(high);
    if (!(height > near_) || at_low * at_high < 0) return nullptr;  // no part of both nappes
    const double r1 = std::abs(at_low), r2 = std::abs(at_high);
    if (!(std::max(r1, r2) > near_)) return nullptr;
    volume = pi * height * (r1 * r1 + r1 * r2 + r2 * r2) / 3;
    return CurvedSolid::cone(s.at(low), s.axis, r1, r2, height);
  }

  const TopoDS_Solid& solid_;
  double size_ = 0, near_ = 0;
  gp_Pnt centre_;
  TopTools_IndexedMapOfShape faces_;
  std::vector<int> surface_of_;  ///< face: number of its surface
  std::vector<Surface> surfaces_;
  int curved_ = -1;
  std::set<double> ends_;  ///< heights of the planes along the curved surface's axis
};

}  // namespace

CurvedSolidPtr recognise(const TopoDS_Solid& solid) {
  try {
    return Recognition(solid).run();
  } catch (const Standard_Failure&) {
    return nullptr;  // damaged: the tessellation says how
  }
}

}  // namespace starcell::cad
