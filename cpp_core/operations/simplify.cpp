#include "operations/simplify.h"

#include "decimation/decimate.h"
#include "operations/changed_mesh.h"

namespace starcell {

Result simplify(const Expression& solid, const Options& options) {
  return changed_mesh(solid, options, "decimating", [](std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, double, const std::function<bool(double)>& go_on) {
    Decimated few = decimate(std::move(vertices), std::move(triangles), most, go_on);
    return Changed{std::move(few.vertices), std::move(few.triangles), few.bound};
  });
}

}  // namespace starcell
