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
  std::vector<Ring> polygons;
};

struct PlanarArm {
  std::array<double, 3> lengths;
  std::array<double, 2> base;
  bool self_collision;
};

using Robot = std::variant<TranslatingRobot, PlanarRobot, PlanarArm>;

struct FreeSpaceRecord : ResultRecord {
  std::vector<std::uint8_t> facet_kind;
  std::optional<std::size_t> components;
};

Robot read_robot(const py::object& robot) {
  if (py::isinstance<TranslatingRobot>(robot)) return robot.cast<TranslatingRobot>();
  if (py::isinstance<PlanarRobot>(robot)) return robot.cast<PlanarRobot>();
  if (py::isinstance<PlanarArm>(robot)) return robot.cast<PlanarArm>();
  throw py::type_error("robot: must be a TranslatingRobot, a PlanarRobot or a PlanarArm");
}

std::pair<py::object, py::object> read_bounds(const py::object& bounds) {
  if (!py::isinstance<py::sequence>(bounds) || py::len(bounds) != 2) throw py::type_error("bounds: must be (lower, upper)");
  const auto both = bounds.cast<py::sequence>();
  return {both[0], both[1]};
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
  const std::vector<Ring> polygons = read_polygons(obstacles, "obstacles");
  if (const auto* planar = std::get_if<PlanarRobot>(&robot)) {
    const auto [low, high] = read_bounds(bounds);
    const ConfigurationProblem problem = planar_robot(planar->polygons, polygons, read_vector2(low, "bounds"), read_vector2(high, "bounds"));
    return run([&](const Options& options) { return free_space(problem, options, decimate); });
  }
  if (!bounds.is_none()) throw py::type_error("bounds: must be None for a PlanarArm");
  const PlanarArm& arm = std::get<PlanarArm>(robot);
  const ConfigurationProblem problem = planar_arm(arm.lengths, arm.base, arm.self_collision, polygons);
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
           py::arg("polygon"), "polygon: (n, 2) floats, simple, in either sense, or a sequence of such, whose union it is. Raises InvalidSolidError for a polygon that crosses itself.");
  py::class_<PlanarArm>(module, "PlanarArm",
                        "Three straight links without width on revolute joints: (theta1, theta2, theta3) in radians, theta_i relative to link i - 1, the first to the x axis.")
      .def(py::init([](const std::array<double, 3>& lengths, const py::object& base, bool self_collision) {
             const PlanarArm arm{lengths, read_vector2(base, "base"), self_collision};
             planar_arm(arm.lengths, arm.base, arm.self_collision, {});   // to be refused here
             return arm;
           }),
           py::arg("link_lengths"), py::arg("base") = py::make_tuple(0.0, 0.0), py::arg("self_collision") = true,
           "link_lengths: three positive floats, model units. base: where the first joint is. self_collision: the last link must not cross the first.");
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
      "robot: TranslatingRobot, PlanarRobot or PlanarArm. obstacles: a Solid for a TranslatingRobot, else polygons, (n, 2) floats each, model units. bounds: (lower, upper) of "
      "the translations; None for an arm. error: two-sided Hausdorff bound in model units, an angle counting robot-radius units a radian (an arm: its length); None: "
      "longest side of the domain / 128. Others as evaluate(). Source: T§5.2-5.4, Appendix B.");
}

}  // namespace starcell::python
