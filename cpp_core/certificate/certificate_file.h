// A certificate as a file: one self-contained JSON text with everything that a check of it needs.
//
// Holds the operands' meshes, the half-spaces, curved solids, offsets and sums, the expression, the options asked for, the result and every field of the
// certificate. Numbers are written shortest round trip, so every double comes back bit-identical; what JSON has no number
// for is the string "infinity", "-infinity" or "nan".
// Guarantees: what read_certificate() returns is finite where it is geometry, and every index is in range. Says nothing
// about the geometry itself: that is the checker's business.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "certificate/certificate.h"
#include "expression/expression.h"

namespace starcell {

struct StoredMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

struct StoredOperand {
  std::string name;
  double deflection = 0.0;  ///< measured distance to the CAD shape it stands for; 0: none
  StoredMesh mesh;
};

/// A rounded offset of an operand.
struct StoredOffset {
  std::uint32_t operand = 0;
  double distance = 0;
  std::vector<std::uint32_t> faces;   ///< of the operand, what it is measured from; none: all of it
};

/// A Minkowski sum of two operands, or (`erosion`) all places where the second one fits into the first.
struct StoredSum {
  std::uint32_t a = 0, b = 0;
  bool erosion = false;
};

/// A node of the expression. A leaf refers to an operand, a half-space, a curved solid, an offset or a sum, an inner node to nodes before it.
struct StoredNode {
  Expression::Kind kind = Expression::Kind::polyhedron;
  std::uint32_t leaf = 0;
  std::vector<std::uint32_t> children;
};

struct CertificateFile {
  std::vector<StoredOperand> operands;
  std::vector<HalfSpace> half_spaces;
  std::vector<CurvedSolidPtr> curved;
  std::vector<StoredOffset> offsets;
  std::vector<StoredSum> sums;
  std::vector<StoredNode> expression;  ///< the last node is the root; empty: the result is no Boolean
  std::optional<double> error;         ///< as asked for; none: the default
  std::optional<double> contact;
  StoredMesh result;
  Certificate certificate;
};

/// Appends the expression's nodes and leaves to the file; a solid that occurs twice is stored once.
void store_expression(const Expression& expression, CertificateFile& file);

/// Throws FileError; whatever stood at `path` before then stays.
void write_certificate(const std::filesystem::path& path, const CertificateFile& file);

/// Throws FileError, which says what is wrong with the file and where.
CertificateFile read_certificate(const std::filesystem::path& path);

}  // namespace starcell
