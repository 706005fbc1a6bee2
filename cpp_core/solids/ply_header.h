// The header of a PLY file: which elements follow, how many of each, and of what types their properties are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace starcell {

enum class PlyType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

inline std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

struct PlyProperty {
  std::string name;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< of a list's length
  PlyType type = PlyType::kFloat32;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kText;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< in bytes: where the data begin
};

/// Throws FileError with the line of what is wrong.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace starcell
