// Checks a saved certificate by independent code: no decision of the engine is asked, CGAL is the judge.
//
// The exact Boolean is computed anew from the operands in the file (corefinement, exact constructions), and the result in
// the file is measured against it. What is exact: closedness, embedding, counts, the exact Boolean. What has a slack, which
// the claim's text states: the distance (CGAL's bounded-error Hausdorff distance, precision bound/20 but not finer than
// 1/1000 of the diagonal; every vertex is measured besides, up to rounding) and the volume (double arithmetic).
// Does not check: isotopy beyond equal counts of components and handles, and the statistics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "certificate/certificate_file.h"

namespace starcell {

enum class Answer { yes, no, unknown };  ///< unknown: could not be checked, the detail says why

struct Claim {
  std::string name;
  Answer holds = Answer::unknown;
  std::string detail;
};

struct CheckReport {
  std::vector<Claim> claims;
  bool ok() const;        ///< nothing was found wrong
  bool complete() const;  ///< everything was checked and holds
};

CheckReport check_certificate(const CertificateFile& file);

/// Throws FileError if there is no well-formed certificate at `path`.
CheckReport check_certificate(const std::filesystem::path& path);

}  // namespace starcell
