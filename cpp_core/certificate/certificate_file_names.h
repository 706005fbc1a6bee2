// The words of the certificate's file format, shared by its writer and its reader.
#pragma once

#include <array>
#include <utility>

#include "certificate/certificate.h"
#include "expression/expression.h"

namespace starcell {

inline constexpr const char* certificate_format = "starcell-certificate";
inline constexpr int certificate_version = 1;

inline constexpr std::array<std::pair<Expression::Kind, const char*>, 8> certificate_kinds{{
    {Expression::Kind::polyhedron, "operand"},
    {Expression::Kind::half_space, "half-space"},
    {Expression::Kind::curved, "curved"},
    {Expression::Kind::offset, "offset"},
    {Expression::Kind::sum, "sum"},
    {Expression::Kind::set_union, "union"},
    {Expression::Kind::intersection, "intersection"},
    {Expression::Kind::complement, "complement"},
}};

inline constexpr std::array<CurvedSolid::Kind, 6> curved_kinds{CurvedSolid::Kind::sphere, CurvedSolid::Kind::ellipsoid,
                                                              CurvedSolid::Kind::cylinder, CurvedSolid::Kind::cone,
                                                              CurvedSolid::Kind::torus, CurvedSolid::Kind::quadric};

/// Is a node of this kind a leaf?
constexpr bool is_leaf(Expression::Kind kind) {
  return kind == Expression::Kind::polyhedron || kind == Expression::Kind::half_space || kind == Expression::Kind::curved ||
         kind == Expression::Kind::offset || kind == Expression::Kind::sum;
}

inline constexpr std::array<Verdict, 3> certificate_verdicts{Verdict::exact, Verdict::contact, Verdict::unresolved};

}  // namespace starcell
