// How far the stitched mesh is from the CAD solid: measured on the mesh itself, in both directions.
//
// Three parts, the largest counts:
//  faces on planes, cylinders, cones, spheres, tori   an upper bound in closed form (elementary_surface.h);
//  faces on other surfaces                            samples: the surface at 12 parameters a triangle against that
//                                                     triangle, the triangle at 12 points against the surface;
//  edges                                              samples: 7 a segment, of the curve, and on curved faces of the
//                                                     strip of surface between curve and chord, against the segment.
// A straight edge is exact at its two ends, a circle's arc at its middle, which is among the samples. All other samples
// are multiplied by 1.25: on a surface with bounded second derivatives the distance between samples exceeds that at
// samples by 1/16 at most.
// Guarantees: 0 for planar faces with straight edges whose vertices lie on their planes to 1e-9 of the solid's size.
// Does not guarantee: a bound for free-form faces with kinks or wiggles finer than a quarter triangle: measured there,
// not proved.
#pragma once

#include <string>
#include <vector>

#include "cad/stitching.h"

namespace starcell::cad {

struct Deflection {
  double value = 0;
  std::string where;  ///< the face or edge that it was measured at
};

Deflection measure_deflection(const std::vector<FaceMesh>& faces, const StitchedMesh& mesh);

}  // namespace starcell::cad
