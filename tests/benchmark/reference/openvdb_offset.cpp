// Times OpenVDB's outward offset of a raw mesh: openvdb_offset MESH RADIUS VOXEL OUT. The mesh becomes a distance field that is wide
// enough, whose surface at RADIUS becomes a mesh. Prints JSON, and writes the result raw.
// Raw: uint32 vertices, uint32 triangles, float64 coordinates, uint32 indices.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const double radius = std::atof(argv[2]), voxel = std::atof(argv[3]);
  std::FILE* file = std::fopen(argv[1], "rb");
  std::uint32_t counts[2] = {0, 0};
  if (!file || std::fread(counts, 4, 2, file) != 2) return 2;
  std::vector<double> raw(3 * std::size_t{counts[0]});
  std::vector<std::uint32_t> corners(3 * std::size_t{counts[1]});
  if (std::fread(raw.data(), 8, raw.size(), file) != raw.size() || std::fread(corners.data(), 4, corners.size(), file) != corners.size()) return 2;
  std::fclose(file);
  openvdb::initialize();
  std::vector<openvdb::Vec3s> points;
  for (std::size_t v = 0; v < counts[0]; ++v) points.emplace_back(raw[3 * v], raw[3 * v + 1], raw[3 * v + 2]);
  std::vector<openvdb::Vec3I> triangles;
  for (std::size_t t = 0; t < counts[1]; ++t) triangles.emplace_back(corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]);

  const auto start = std::chrono::steady_clock::now();
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  const auto grid = openvdb::tools::meshToSignedDistanceField<openvdb::FloatGrid>(
      *transform, points, triangles, {}, static_cast<float>(radius / voxel + 3), 3.0f);
  std::vector<openvdb::Vec3s> out;
  std::vector<openvdb::Vec3I> made;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, out, made, quads, radius, 0.0);
  for (const auto& q : quads) made.emplace_back(q[0], q[1], q[2]), made.emplace_back(q[0], q[2], q[3]);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  std::FILE* result = std::fopen(argv[4], "wb");
  if (!result) return 2;
  const std::uint32_t sizes[2] = {static_cast<std::uint32_t>(out.size()), static_cast<std::uint32_t>(made.size())};
  std::fwrite(sizes, 4, 2, result);
  for (const auto& p : out) {
    const double place[3] = {p[0], p[1], p[2]};
    std::fwrite(place, 8, 3, result);
  }
  for (const auto& t : made) {
    const std::uint32_t corner[3] = {t[0], t[1], t[2]};
    std::fwrite(corner, 4, 3, result);
  }
  std::fclose(result);
  std::printf("{\"seconds\": %.6f, \"triangles\": %zu}\n", seconds, made.size());
}
