#include "numerics/linear_program.h"

#include <memory>

#include <glpk.h>

namespace starcell {
namespace {

// Variables: x, y, z and the margin t. Rows: rows[i] . (x, y, z) - t >= rhs[i]. Maximises t.
std::optional<Vec3> maximise_margin(const std::vector<Vec3>& rows, const std::vector<double>& rhs, const Vec3& lower,
                                    const Vec3& upper) {
  if (rows.empty()) return std::nullopt;
  const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem(glp_create_prob(), &glp_delete_prob);
  glp_prob* lp = problem.get();
  glp_set_obj_dir(lp, GLP_MAX);
  glp_add_cols(lp, 4);
  for (int k = 0; k < 3; ++k) glp_set_col_bnds(lp, k + 1, lower[k] < upper[k] ? GLP_DB : GLP_FX, lower[k], upper[k]);
  glp_set_col_bnds(lp, 4, GLP_FR, 0, 0);
  glp_set_obj_coef(lp, 4, 1.0);
  glp_add_rows(lp, static_cast<int>(rows.size()));
  const int columns[5] = {0, 1, 2, 3, 4};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double values[5] = {0, rows[i].x(), rows[i].y(), rows[i].z(), -1.0};
    glp_set_mat_row(lp, static_cast<int>(i) + 1, 4, columns, values);
    glp_set_row_bnds(lp, static_cast<int>(i) + 1, GLP_LO, rhs[i], 0);
  }
  glp_smcp parameters;
  glp_init_smcp(&parameters);
  parameters.msg_lev = GLP_MSG_OFF;
  parameters.it_lim = 1000;
  if (glp_simplex(lp, &parameters) != 0 || glp_get_status(lp) != GLP_OPT) return std::nullopt;
  if (!(glp_get_col_prim(lp, 4) > 0)) return std::nullopt;
  return Vec3(glp_get_col_prim(lp, 1), glp_get_col_prim(lp, 2), glp_get_col_prim(lp, 3));
}

}  // namespace

std::optional<Vec3> widest_direction(const std::vector<Vec3>& normals) {
  return maximise_margin(normals, std::vector<double>(normals.size(), 0.0), Vec3::Constant(-1), Vec3::Constant(1));
}

std::optional<Vec3> deepest_point(const std::vector<Vec3>& normals, const std::vector<Vec3>& points, const Box3& box) {
  // n . (p - o) >= t  <=>  (-n) . o - t >= -n . p, relative to the box's centre to keep numbers small.
  const Vec3 centre = box.center();
  std::vector<Vec3> rows;
  std::vector<double> rhs;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    rows.push_back(-normals[i]);
    rhs.push_back(-normals[i].dot(points[i] - centre));
  }
  const auto o = maximise_margin(rows, rhs, box.min() - centre, box.max() - centre);
  if (!o) return std::nullopt;
  return *o + centre;
}

}  // namespace starcell
