// Offsets, shells and morphology with a ball (T§1.2, T§4.2; Rossignac & Requicha 1986).
//
// An offset is an expression: outward it passes through unions, inward through intersections, and turns round at a complement;
// much has a closed form (closed_offset.h), polyhedra have distance surfaces. What is left, a Boolean or a curved solid without a
// closed form, is meshed and decimated first, within a share of the error, and named in the certificate as tessellated.
// Guarantees: the certificate's, about the offset of the solid as named there. Does not guarantee that the offset of a tessellated
// solid has the topology of the true one's where walls are as near to 2r as the tessellation is coarse.
#pragma once

#include "operations/boolean.h"

namespace starcell {

/// What a morphological operation evaluates, and what it was told to meet.
struct Prepared {
  Expression expression;
  Options options;
};

/// The rounded offset, outward (distance > 0) or inward. Throws as evaluate(), std::invalid_argument naming `distance`.
Prepared prepare_offset(const Expression& solid, double distance, const Options& options);
/// A wall of the given thickness outside the solid (> 0) or inside it (< 0). Where faces are left open there is none: the wall is what
/// lies within its thickness of the others. They are CAD faces of an imported polyhedron, or triangles of one that is no import;
/// std::invalid_argument for other solids, for numbers that are none of them, and if none would stay.
Prepared prepare_shell(const Expression& solid, double thickness, const Options& options, const std::vector<std::int64_t>& open_faces = {});
/// Erosion and dilation by a ball: parts thinner than 2 radius go, corners are rounded; or, closing, gaps and slots are filled.
Prepared prepare_opening(const Expression& solid, double radius, const Options& options);
Prepared prepare_closing(const Expression& solid, double radius, const Options& options);

}  // namespace starcell
