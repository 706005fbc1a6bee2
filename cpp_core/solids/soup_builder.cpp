// Fanning and the range check, shared by every format.
#include "solids/soup_builder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solids/errors.h"

namespace starcell {

void SoupBuilder::expect(std::uint64_t vertices, std::uint64_t triangles, std::size_t bytes, std::size_t bytes_a_vertex) {
  soup_.vertices.reserve(std::min<std::uint64_t>(vertices, bytes / bytes_a_vertex));
  soup_.triangles.reserve(std::min<std::uint64_t>(triangles, bytes / 4));  // three indices and what ends them
}

bool SoupBuilder::corner(std::int64_t index) {
  if (index < 0 || index >= std::numeric_limits<std::uint32_t>::max()) return false;
  const auto v = static_cast<std::uint32_t>(index);
  if (corners_ == 0) first_ = v;
  if (corners_ >= 2) soup_.triangles.push_back({first_, last_, v});
  last_ = v;
  ++corners_;
  return true;
}

TriangleSoup SoupBuilder::finish(const std::string& name) {
  const std::size_t count = soup_.vertices.size();
  for (std::size_t t = 0; t < soup_.triangles.size(); ++t)
    for (std::uint32_t v : soup_.triangles[t])
      if (v >= count)
        throw FileError(name + ": triangle " + std::to_string(t) + " uses vertex " + std::to_string(v) +
                        " (counted from 0), but there are only " + std::to_string(count) + " vertices.");
  return std::move(soup_);
}

}  // namespace starcell
