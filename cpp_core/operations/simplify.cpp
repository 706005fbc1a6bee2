#include "operations/simplify.h"

#include "decimation/decimate.h"
#include "operations/changed_mesh.h"

namespace starcell {
namespace {

// Contouring takes what is far finer than the error together at once; collapses take it edge by edge, for a tenth to a third fewer triangles in the end.
constexpr std::size_t huge = 150000;

}  // namespace

Result simplify(const Expression& solid, const Options& options) {
  return changed_mesh(solid, options, "decimating", [](std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, double, const std::function<bool(double)>& go_on) {
    Decimated few = decimate(std::move(vertices), std::move(triangles), most, go_on);
    return Changed{std::move(few.vertices), std::move(few.triangles), few.bound};
  }, huge);
}

}  // namespace starcell
