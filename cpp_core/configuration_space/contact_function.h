// How far a corner of one convex piece is beyond the line of another's side: > 0 outside.
//
// Type A: a moving corner p against a fixed line, n . (t + R p - a); type B: a fixed corner o against a moving line, (R m) . (o - t) - m . b (Lozano-Perez
// 1983; T§5.4, Appendix B). Both are linear in the six functions of the moving frame. Normals are of unit length, to rounding: the line is exact,
// the distance is scaled.
#pragma once

#include "configuration_space/convex_pieces.h"
#include "configuration_space/moving_frame.h"
#include "solids/smooth_surface.h"

namespace starcell {

struct ContactFunction {
  enum class Kind : std::uint8_t { moving_corner, moving_side };

  Kind kind;
  bool along;                  ///< the side's sense on its line
  std::uint32_t body;          ///< whose frame: identity, with line and corner
  std::uint32_t line, corner;
  std::array<Interval, 4> coefficients;   ///< of x, y, cosine, sine; or of cosine, sine, seen_x, seen_y
  Interval constant;
  /// The frame's angles at which the corner is the one farthest behind the line: from middle - width to middle + width, and full turns from there.
  double middle, width;

  /// Exactly the same function, and the same one with the other sign.
  bool same(const ContactFunction& o) const { return kind == o.kind && along == o.along && body == o.body && line == o.line && corner == o.corner; }
  bool opposite(const ContactFunction& o) const { return kind == o.kind && along != o.along && body == o.body && line == o.line && corner == o.corner; }
  Expansion expand(const FrameFunctions& f, const Vec3& reach) const;
  /// Its range, to first order.
  Interval range(const FrameFunctions& f, const Vec3& reach) const;
  double value(const FrameFunctions& f, Vec3* gradient) const;
  /// Can the frame have one of those angles?
  bool applies(const Interval& angle) const;
};

/// Corner `corner` of the moving piece against side `side` of the fixed one. They need a Rounding object.
ContactFunction moving_corner(std::uint32_t body, const ConvexPiece& moving, std::size_t corner, const PieceTree& fixed, const ConvexPiece& piece, std::size_t side,
                              const PieceTree& of_moving);
/// Corner `corner` of the fixed piece against side `side` of the moving one.
ContactFunction moving_side(std::uint32_t body, const PieceTree& moving, const ConvexPiece& piece, std::size_t side, const ConvexPiece& fixed, std::size_t corner,
                            const PieceTree& of_fixed);

}  // namespace starcell
