#include "subdivision/face_join.h"

#include <algorithm>

namespace starcell {
namespace {

void append(Arc& arc, const Arc& tail, const Grid* joints) {
  // Where both parts lie on one plane the joint is no bend.
  const bool bend = joints && (arc.surfaces.back() == no_surface || arc.surfaces.back() != tail.surfaces.front());
  if (bend) arc.bends.push_back(place_of(arc.end, *joints));
  arc.bends.insert(arc.bends.end(), tail.bends.begin(), tail.bends.end());
  arc.surfaces.insert(arc.surfaces.end(), tail.surfaces.begin() + (bend ? 0 : 1), tail.surfaces.end());
  arc.end = tail.end;
  arc.contact = arc.contact || tail.contact;
  arc.concurrent = arc.concurrent || tail.concurrent;
  if (arc.sway != 0 || tail.sway != 0) arc.along = Vec3::Zero();
  arc.sway = std::max(arc.sway, tail.sway);
}

// A closed curve's first and last piece meet in its start.
bool close_joined(Arc& arc, const Grid* joints) {
  if (!joints || arc.surfaces.front() != no_surface) return close(arc);
  arc.bends.insert(arc.bends.begin(), place_of(arc.start, *joints));
  if (arc.bends.size() < 3) return false;
  arc.closed = true;
  return true;
}

}  // namespace

std::optional<std::vector<Arc>> join_arcs(std::vector<Arc> parts, const Grid* joints) {
  std::vector<Arc> arcs;
  std::erase_if(parts, [&](Arc& part) {
    if (part.closed) arcs.push_back(std::move(part));
    return part.closed;
  });
  const auto starting_at = [&](const Crossing& x) {
    return static_cast<std::size_t>(std::find_if(parts.begin(), parts.end(), [&](const Arc& p) { return p.start == x; }) -
                                    parts.begin());
  };
  std::vector<char> inner(parts.size(), 0), used(parts.size(), 0);
  for (const Arc& arc : parts)
    if (const std::size_t next = starting_at(arc.end); next < parts.size()) inner[next] = 1;
  for (const bool closed : {false, true})
    for (std::size_t first = 0; first < parts.size(); ++first) {
      if (used[first] || (!closed && inner[first])) continue;
      Arc arc = parts[first];
      used[first] = 1;
      std::size_t next = starting_at(arc.end);
      for (; next < parts.size() && !used[next]; next = starting_at(arc.end)) {
        used[next] = 1;
        append(arc, parts[next], joints);
      }
      if ((next == parts.size()) == closed) return std::nullopt;
      if (closed && (next != first || !close_joined(arc, joints))) return std::nullopt;
      arcs.push_back(std::move(arc));
    }
  return arcs;
}

}  // namespace starcell
