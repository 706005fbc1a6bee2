// TranslatingRobot, PlanarRobot, PlanarArm and free_space(): the configurations in which a robot is free, as a certified mesh.
#include "configuration_space/free_space.h"

#include <pybind11/stl.h>

#include <variant>

#include "arrays.h"
#include "run_operation.h"

namespace starcell::python {
namespace {

struct TranslatingRobot {
  Expression solid;
};

struct PlanarRobot {
  std::vector<PlanarPolygon> polygons;
};

using Robot = std::variant<TranslatingRobot, PlanarRobot, Arm>;

struct FreeSpaceRecord : ResultRecord {
  std::vector<std::uint8_t> facet_kind;
  std::optional<std::size_t> components;
};

Robot read_robot(const py::object& robot) {
  if (py::isinstance<TranslatingRobot>(robot)) return robot.cast<TranslatingRobot>();
  if (py::isinstance<PlanarRobot>(robot)) return robot.cast<PlanarRobot>();
  if (py::isinstance<Arm>(robot)) return robot.cast<Arm>();
  throw py::type_error("robot: must be a TranslatingRobot, a PlanarRobot or a PlanarArm");
}

std::pair<py::object, py::object> read_bounds(const py::object& bounds) {
  if (!py::isinstance<py::sequence>(bounds) || py::len(bounds) != 2) throw py::type_error("bounds: must be (lower, upper)");
  const auto both = bounds.cast<py::sequence>();
  return {both[0], both[1]};
}

py::object one_of_three(const py::object& three, std::size_t k, const char* what) {
  if (three.is_none()) return three;
  if (!py::isinstance<py::sequence>(three) || py::len(three) != 3) throw py::type_error(std::string(what) + ": must be None or three of them");
  return three.cast<py::sequence>()[k];
}

py::object free_space_of(const Robot& robot, const py::object& obstacles, const py::object& bounds, std::optional<double> error, std::optional<double> contact, int threads,
                         const std::optional<Budget>& budget, const py::object& progress, const std::string& on_unresolved, bool decimate) {
  const auto run = [&](const auto& make) {
    return run_operation<FreeSpaceRecord>(read_options(error, contact, "trace", threads, budget), progress, on_unresolved, [&](const Options& options, FreeSpaceRecord& record) {
      FreeSpace space = make(options);
      record.result = std::move(space.result);
      record.facet_kind = std::move(space.facet_kind);
      record.components = space.components;
    });
  };
  if (const auto* translating = std::get_if<TranslatingRobot>(&robot)) {
    if (!py::isinstance<Expression>(obstacles)) throw py::type_error("obstacles: must be a Solid for a TranslatingRobot");
    const auto solid = obstacles.cast<Expression>();
    const auto [low, high] = read_bounds(bounds);
    const Vec3 lower = read_vector(low, "bounds"), upper = read_vector(high, "bounds");
    return run([&](const Options& options) { return free_translations(translating->solid, solid, lower, upper, options, decimate); });
  }
  const std::vector<PlanarPolygon> polygons = read_polygons(obstacles, "obstacles");
  if (const auto* planar = std::get_if<PlanarRobot>(&robot)) {
    const auto [low, high] = read_bounds(bounds);
    const ConfigurationProblem problem = planar_robot(planar->polygons, polygons, read_vector2(low, "bounds"), read_vector2(high, "bounds"));
    return run([&](const Options& options) { return free_space(problem, options, decimate); });
  }
  if (!bounds.is_none()) throw py::type_error("bounds: must be None for a PlanarArm");
  const ConfigurationProblem problem = planar_arm(std::get<Arm>(robot), polygons);
  return run([&](const Options& options) { return free_space(problem, options, decimate); });
}

}  // namespace

void bind_configuration_space(py::module_& module) {
  py::class_<TranslatingRobot>(module, "TranslatingRobot", "A solid that translates: its configuration is (x, y, z), where the origin of its coordinates is.")
      .def(py::init([](const Expression& solid) { return TranslatingRobot{solid}; }), py::arg("solid"), "solid: Solid, model units.");
  py::class_<PlanarRobot>(module, "PlanarRobot", "Polygons in one rigid piece that translate and turn about the origin of their coordinates: (x, y, theta), model units and radians.")
      .def(py::init([](const py::object& polygon) {
             PlanarRobot robot{read_polygons(polygon, "polygon")};
             if (robot.polygons.empty()) throw py::value_error("polygon: the robot has none");
             piece_tree(robot.polygons, "polygon");   // to be refused here
             return robot;
           }),
           py::arg("polygon"), "polygon: (n, 2) floats, simple, in either sense, or a sequence of such, whose union it is; one of these may be a sequence of its outer ring and its holes. Raises InvalidSolidError for a polygon that crosses itself.");
  py::class_<Arm>(module, "PlanarArm",
                  "Three links on revolute joints: (theta1, theta2, theta3) in radians, theta_i relative to link i - 1, the first to the x axis.")
      .def(py::init([](const std::array<double, 3>& lengths, const py::object& base, bool self_collision, const py::object& joint_limits, const py::object& link_shapes) {
             Arm arm{lengths, read_vector2(base, "base"), self_collision};
             for (std::size_t k = 0; k < 3; ++k) {
               if (const py::object limits = one_of_three(joint_limits, k, "joint_limits"); !limits.is_none()) arm.limits[k] = read_vector2(limits, "joint_limits");
               if (const py::object shape = one_of_three(link_shapes, k, "link_shapes"); !shape.is_none()) arm.shapes[k] = read_polygons(shape, "link_shapes");
             }
             planar_arm(arm, {});   // to be refused here
             return arm;
           }),
           py::arg("link_lengths"), py::arg("base") = py::make_tuple(0.0, 0.0), py::arg("self_collision") = true, py::arg("joint_limits") = py::none(), py::arg("link_shapes") = py::none(),
           "link_lengths: three positive floats from joint to joint, model units. base: where the first joint is. self_collision: the last link must not meet the first; neighbours "
           "are up to joint_limits, three of (lower, upper) in radians or None, a joint that goes round. link_shapes: three of polygons, (n, 2) floats each in the link's frame, "
           "whose joint is the origin and whose next one is at (length, 0); or None, a straight line without width. Raises ValueError for limits that are empty or more than a turn.");
  py::class_<FreeSpaceRecord, ResultRecord, std::shared_ptr<FreeSpaceRecord>>(
      module, "FreeSpace", "A Result whose mesh bounds the free configurations within their domain: translations in model units, angles in radians, unrolled to [0, 2 pi] as the last coordinates.")
      .def_property_readonly(
          "facet_kind",
          [](const FreeSpaceRecord& self) { return py::array_t<std::uint8_t>(static_cast<py::ssize_t>(self.facet_kind.size()), self.facet_kind.data()); },
          "(m,) uint8, per triangle: 0 of a contact surface, 1 of the bounds or of the cut at an angle of 0 or 2 pi.")
      .def_property_readonly(
          "free_components", [](const FreeSpaceRecord& self) { return self.components; },
          "The number of connected components of the free configurations, where an angle of 2 pi is one of 0. None: not told at this error, as some part of the cut is narrower.");
  module.def(
      "free_space",
      [](const py::object& robot, const py::object& obstacles, const py::object& bounds, std::optional<double> error,
         std::optional<double> contact, int threads, const std::optional<Budget>& budget, const py::object& progress, const std::string& on_unresolved, bool decimate) {
        return free_space_of(read_robot(robot), obstacles, bounds, error, contact, threads, budget, progress, on_unresolved, decimate);
      },
      py::arg("robot"), py::arg("obstacles"), py::arg("bounds"), py::arg("error") = py::none(), py::arg("contact") = py::none(), py::arg("threads") = 0, py::arg("budget") = py::none(),
      py::arg("progress") = py::none(), py::arg("on_unresolved") = "return", py::arg("decimate") = true,
      "The configurations in which the robot meets no obstacle, as a FreeSpace.\n\n"
      "robot: TranslatingRobot, PlanarRobot or PlanarArm. obstacles: a Solid for a TranslatingRobot, else polygons, (n, 2) floats each or an outer ring and holes, model units. bounds: (lower, upper) of "
      "the translations; None for an arm. error: two-sided Hausdorff bound in model units, an angle counting robot-radius units a radian (an arm: its length); None: "
      "longest side of the domain / 128. Others as evaluate(). Source: T§5.2-5.4, Appendix B.");
}

}  // namespace starcell::python
