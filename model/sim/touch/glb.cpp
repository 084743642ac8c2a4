// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of GLB files, by TinyGLTF. It opens no other file, and decodes no picture. Every index and
// length of the file is checked here before it is used. Documentation: docs/touch.md
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/touch/touch.hpp"

namespace feltgate::touch {

namespace {

constexpr std::int64_t most_bytes = std::int64_t{1} << 29;
constexpr std::size_t most_triangles = 4'000'000;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

/// A transform of a node: columns and translation.
struct Transform {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, to{};

  Vec3 turn(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3 operator()(Vec3 v) const { return turn(v) + to; }
  bool mirrors() const { return plant::dot(plant::cross(x, y), z) < 0; }
};
Transform operator*(const Transform& a, const Transform& b) {
  return {a.turn(b.x), a.turn(b.y), a.turn(b.z), a(b.to)};
}

/// glTF has y up and looks along -z; the device has z up.
constexpr Transform device_frame{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}};

/// Of a quaternion x, y, z, w of any length.
Transform rotation_of(const double* q) {
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(norm > 0)) refuse("a node's rotation is 0");
  const plant::Quaternion turn{q[3] / norm, q[0] / norm, q[1] / norm, q[2] / norm};
  const Transform none;
  return {turn.turn(none.x), turn.turn(none.y), turn.turn(none.z), {}};
}
Transform scale_of(Vec3 s) { return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}}; }

Transform transform_of(const tinygltf::Node& node) {
  const auto sized = [&](const std::vector<double>& v, std::size_t n, const char* what) {
    if (!v.empty() && v.size() != n)
      refuse(fmt::format("a node's {} has {} numbers", what, v.size()));
    return !v.empty();
  };
  if (sized(node.matrix, 16, "matrix")) {
    const auto column = [&](std::size_t n) {
      return Vec3{node.matrix[4 * n], node.matrix[4 * n + 1], node.matrix[4 * n + 2]};
    };
    return {column(0), column(1), column(2), column(3)};
  }
  Transform t;
  if (sized(node.rotation, 4, "rotation")) t = rotation_of(node.rotation.data());
  if (sized(node.scale, 3, "scale"))
    t = t * scale_of({node.scale[0], node.scale[1], node.scale[2]});
  if (sized(node.translation, 3, "translation")) {
    t.to = {node.translation[0], node.translation[1], node.translation[2]};
  }
  return t;
}

/// The elements of an accessor, checked to lie within their buffer.
class Elements {
 public:
  Elements(const tinygltf::Model& model, int index, int type) {
    const auto& a = model.accessors.at(at(index, model.accessors.size(), "accessor"));
    if (a.sparse.isSparse || a.bufferView < 0) {
      refuse("a sparse accessor, which is not read; export without morph targets or compression");
    }
    const auto& view =
        model.bufferViews.at(at(a.bufferView, model.bufferViews.size(), "bufferView"));
    const auto& data = model.buffers.at(at(view.buffer, model.buffers.size(), "buffer")).data;
    const int bytes =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType));
    if (a.type != type || bytes <= 0) refuse("an accessor of another type than its use");
    component_ = a.componentType;
    normalized_ = a.normalized;
    bytes_ = static_cast<std::size_t>(bytes);
    count_ = a.count;
    const std::size_t size = bytes_ * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                          static_cast<std::uint32_t>(type)));
    stride_ = view.byteStride == 0 ? size : view.byteStride;
    const bool view_fits =
        view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset;
    const bool fits =
        view_fits && stride_ >= size && a.byteOffset <= view.byteLength &&
        (count_ == 0 || (size <= view.byteLength - a.byteOffset &&
                         (count_ - 1) <= (view.byteLength - a.byteOffset - size) / stride_));
    if (!fits) refuse("an accessor that reaches beyond its buffer: the file is cut off or broken");
    data_ = data.data() + view.byteOffset + a.byteOffset;
  }
  std::size_t count() const { return count_; }
  int component() const { return component_; }

  /// Part `k` of an element: a float, or a whole number of 8 or 16 bits, as quantization leaves
  /// them; a normalized one is from -1 or 0 to 1.
  double number(std::size_t n, std::size_t k) const {
    const unsigned char* from = data_ + n * stride_ + k * bytes_;
    switch (component_) {
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return static_cast<double>(loaded<float>(from));
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return whole_number<std::int8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return whole_number<std::uint8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return whole_number<std::int16_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return whole_number<std::uint16_t>(from);
      default:
        refuse("positions that are neither floats nor whole numbers of 8 or 16 bits");
    }
  }
  Vec3 vector(std::size_t n) const { return {number(n, 0), number(n, 1), number(n, 2)}; }
  std::uint32_t whole(std::size_t n) const {
    const unsigned char* from = data_ + n * stride_;
    if (component_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *from;
    if (component_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return loaded<std::uint16_t>(from);
    return loaded<std::uint32_t>(from);
  }

 private:
  template <class T>
  static T loaded(const unsigned char* from) {
    T v;
    std::memcpy(&v, from, sizeof(v));
    return v;
  }
  template <class T>
  double whole_number(const unsigned char* from) const {
    const double v = loaded<T>(from);
    return normalized_ ? std::max(v / std::numeric_limits<T>::max(), -1.0) : v;
  }
  static std::size_t at(int index, std::size_t size, const char* what) {
    if (index < 0 || static_cast<std::size_t>(index) >= size) {
      refuse(fmt::format("{} {} does not exist", what, index));
    }
    return static_cast<std::size_t>(index);
  }

  const unsigned char* data_ = nullptr;
  std::size_t count_ = 0, stride_ = 0, bytes_ = 0;
  int component_ = 0;
  bool normalized_ = false;
};

class Reader {
 public:
  explicit Reader(const tinygltf::Model& model) : model_(model), seen_(model.nodes.size(), false) {}

  Soup read() {
    for (const int root : roots()) visit(root, device_frame, 0);
    if (soup_.triangles.empty()) refuse("no triangles; export a mesh");
    soup_.animations = static_cast<std::int64_t>(model_.animations.size());
    return std::move(soup_);
  }

 private:
  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const int named = std::max(0, model_.defaultScene);
      if (static_cast<std::size_t>(named) >= model_.scenes.size()) {
        refuse(fmt::format("scene {} does not exist", named));
      }
      return model_.scenes[static_cast<std::size_t>(named)].nodes;
    }
    std::vector<bool> child(model_.nodes.size(), false);
    for (const auto& node : model_.nodes) {
      for (const int n : node.children) {
        if (n >= 0 && static_cast<std::size_t>(n) < child.size())
          child[static_cast<std::size_t>(n)] = true;
      }
    }
    std::vector<int> all;
    for (std::size_t n = 0; n < child.size(); ++n) {
      if (!child[n]) all.push_back(static_cast<int>(n));
    }
    return all;
  }

  void visit(int index, const Transform& above, int depth) {
    if (index < 0 || static_cast<std::size_t>(index) >= seen_.size()) {
      refuse(fmt::format("node {} does not exist", index));
    }
    const auto n = static_cast<std::size_t>(index);
    // The nodes of glTF are trees; a ring of them would have no end.
    if (seen_[n] || depth > 1000)
      refuse(fmt::format("node {} is below two nodes or too deep", index));
    seen_[n] = true;
    const tinygltf::Node& node = model_.nodes[n];
    const Transform here = above * transform_of(node);
    soup_.skins += node.skin >= 0 ? 1 : 0;
    if (node.mesh >= 0) {
      if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) {
        refuse(fmt::format("mesh {} does not exist", node.mesh));
      }
      const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
      const auto& weights = node.weights.empty() ? mesh.weights : node.weights;
      for (const Transform& instance : instances_of(node)) {
        for (const auto& p : mesh.primitives) add(p, here * instance, weights);
      }
    }
    for (const int child : node.children) visit(child, here, depth + 1);
  }

  /// Where EXT_mesh_gpu_instancing puts a node's mesh; once, as it is, without that.
  std::vector<Transform> instances_of(const tinygltf::Node& node) const {
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end()) return {Transform{}};
    const tinygltf::Value& attributes = found->second.Get("attributes");
    std::vector<Transform> all;
    const auto each = [&](const char* name, int type, auto&& apply) {
      if (!attributes.Has(name)) return;
      const tinygltf::Value& index = attributes.Get(name);
      if (!index.IsNumber()) refuse("an attribute of instances that is no accessor");
      const Elements values(model_, index.GetNumberAsInt(), type);
      if (all.empty()) all.resize(values.count());
      if (all.size() != values.count()) refuse("attributes of instances that differ in number");
      for (std::size_t n = 0; n < all.size(); ++n) apply(all[n], values, n);
    };
    each("ROTATION", TINYGLTF_TYPE_VEC4, [](Transform& t, const Elements& v, std::size_t n) {
      const double q[] = {v.number(n, 0), v.number(n, 1), v.number(n, 2), v.number(n, 3)};
      t = rotation_of(q);
    });
    each("SCALE", TINYGLTF_TYPE_VEC3,
         [](Transform& t, const Elements& v, std::size_t n) { t = t * scale_of(v.vector(n)); });
    each("TRANSLATION", TINYGLTF_TYPE_VEC3,
         [](Transform& t, const Elements& v, std::size_t n) { t.to = v.vector(n); });
    return all;
  }

  /// The vertices of a primitive, with its morph targets by their weights.
  std::vector<Vec3> vertices_of(const tinygltf::Primitive& p, int positions,
                                const std::vector<double>& weights) const {
    const Elements places(model_, positions, TINYGLTF_TYPE_VEC3);
    if (places.count() > 3 * most_triangles - std::min(soup_.at.size(), 3 * most_triangles))
      too_many();
    std::vector<Vec3> vertices;
    vertices.reserve(places.count());
    for (std::size_t n = 0; n < places.count(); ++n) vertices.push_back(places.vector(n));
    if (weights.size() > p.targets.size()) refuse("more weights than morph targets");
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const auto moved = p.targets[k].find("POSITION");
      if (weights[k] == 0 || moved == p.targets[k].end()) continue;
      const Elements by(model_, moved->second, TINYGLTF_TYPE_VEC3);
      if (by.count() != vertices.size()) refuse("a morph target of another number of vertices");
      for (std::size_t n = 0; n < vertices.size(); ++n)
        vertices[n] = vertices[n] + weights[k] * by.vector(n);
    }
    return vertices;
  }

  void add(const tinygltf::Primitive& p, const Transform& here,
           const std::vector<double>& weights) {
    if (p.extensions.count("KHR_draco_mesh_compression") != 0) {
      refuse("a mesh compressed by Draco, which is not read; export without compression");
    }
    if (p.mode >= 0 && p.mode < TINYGLTF_MODE_TRIANGLES) {
      ++soup_.not_triangles;
      return;
    }
    const auto found = p.attributes.find("POSITION");
    if (found == p.attributes.end()) refuse("a primitive without POSITION");
    const std::vector<Vec3> vertices = vertices_of(p, found->second, weights);
    ++soup_.primitives;
    const std::size_t first = soup_.at.size();
    for (std::size_t n = 0; n < vertices.size(); ++n) {
      const Vec3 v = here(vertices[n]);
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
        refuse(fmt::format("vertex {} of a primitive is not finite", n));
      }
      soup_.at.push_back(v);
    }
    std::vector<std::uint32_t> order;
    if (p.indices >= 0) {
      const Elements indices(model_, p.indices, TINYGLTF_TYPE_SCALAR);
      if (indices.component() != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
          indices.component() != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
          indices.component() != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        refuse("indices that are no unsigned whole numbers");
      }
      if (indices.count() > 3 * most_triangles) too_many();
      for (std::size_t n = 0; n < indices.count(); ++n) order.push_back(indices.whole(n));
    } else {
      for (std::size_t n = 0; n < vertices.size(); ++n)
        order.push_back(static_cast<std::uint32_t>(n));
    }
    for (const std::uint32_t n : order) {
      if (n >= vertices.size()) refuse(fmt::format("index {} of {} vertices", n, vertices.size()));
    }
    connect(p.mode, order, static_cast<std::uint32_t>(first), here.mirrors());
    soup_.parts.resize(soup_.triangles.size(), part_of(p.material));
  }

  /// The place of a material by its name; materials of one name are one.
  std::uint32_t part_of(int material) {
    std::string name = "none";
    if (material >= 0 && static_cast<std::size_t>(material) < model_.materials.size()) {
      name = model_.materials[static_cast<std::size_t>(material)].name;
      if (name.empty()) name = fmt::format("material{}", material);
    }
    auto& all = soup_.materials;
    const auto at = std::find(all.begin(), all.end(), name);
    if (at == all.end()) all.push_back(name);
    return static_cast<std::uint32_t>(std::find(all.begin(), all.end(), name) - all.begin());
  }

  void connect(int mode, const std::vector<std::uint32_t>& order, std::uint32_t first,
               bool mirrored) {
    const bool list = mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN;
    for (std::size_t n = 0; n + 2 < order.size(); n += list ? 3 : 1) {
      if (soup_.triangles.size() >= most_triangles) too_many();
      Triangle t{order[n], order[n + 1], order[n + 2]};
      if (mode == TINYGLTF_MODE_TRIANGLE_STRIP && n % 2 == 1) std::swap(t[1], t[2]);
      if (mode == TINYGLTF_MODE_TRIANGLE_FAN) t[0] = order[0];
      if (mirrored) std::swap(t[1], t[2]);
      for (std::uint32_t& corner : t) corner += first;
      soup_.triangles.push_back(t);
    }
  }
  [[noreturn]] static void too_many() {
    refuse(fmt::format("more than {} triangles; decimate it first", most_triangles));
  }

  const tinygltf::Model& model_;
  std::vector<bool> seen_;
  Soup soup_;
};

std::vector<unsigned char> bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) refuse("cannot be read; name a GLB file");
  const auto size = static_cast<std::int64_t>(file.tellg());
  if (size < 0 || size > most_bytes) refuse("longer than 512 MB, or no file; decimate it first");
  if (size < 20) refuse("too short for a GLB file");
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), size)) refuse("cannot be read");
  if (std::memcmp(bytes.data(), "glTF", 4) != 0) refuse("no GLB file; export as binary glTF, .glb");
  std::uint32_t version = 0, length = 0;
  std::memcpy(&version, bytes.data() + 4, sizeof(version));
  std::memcpy(&length, bytes.data() + 8, sizeof(length));
  if (version != 2) refuse(fmt::format("glTF {}, and 2 is read; export as glTF 2.0", version));
  if (length > bytes.size()) {
    refuse(fmt::format("cut off: {} of {} bytes; copy or export it again", bytes.size(), length));
  }
  return bytes;
}

/// Whether an extension is read here, or changes only the looks.
bool knows(const std::string& extension) {
  for (const char* with : {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_materials_",
                           "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_xmp"}) {
    if (extension.rfind(with, 0) == 0) return true;
  }
  return false;
}

/// Refuses what the file's `extensionsRequired` names and this reader does not know, before
/// TinyGLTF stumbles over it. Returns what else it uses and is not known.
std::vector<std::string> check_extensions(const std::vector<unsigned char>& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  const auto from = bytes.begin() + 20;
  const auto to = from + std::min<std::ptrdiff_t>(length, bytes.end() - from);
  std::vector<std::string> unknown;
  const std::string key = "\"extensions";
  if (std::search(from, to, key.begin(), key.end()) == to) return unknown;
  const auto json = nlohmann::json::parse(from, to, nullptr, false);
  const auto names = [&](const char* list, auto&& each) {
    const auto found = json.is_object() ? json.find(list) : json.end();
    if (!json.is_object() || found == json.end() || !found->is_array()) return;
    for (const auto& name : *found) {
      if (!name.is_string()) continue;
      const std::string text = name.get<std::string>().substr(0, 60);
      if (!knows(text)) each(text);
    }
  };
  names("extensionsRequired", [](const std::string& name) {
    refuse(fmt::format("needs the extension {}, which is not read; export without it", name));
  });
  names("extensionsUsed", [&](const std::string& name) { unknown.push_back(name); });
  return unknown;
}

/// Later TinyGLTFs have one callback more, and take all or none of them.
template <class Callbacks>
auto no_sizes(Callbacks& none, int) -> decltype(void(none.GetFileSizeInBytes)) {
  none.GetFileSizeInBytes = [](std::size_t*, std::string*, const std::string&, void*) {
    return false;
  };
}
template <class Callbacks>
void no_sizes(Callbacks&, long) {}

/// Lets TinyGLTF see no other file; remembers what it asked for.
tinygltf::FsCallbacks no_files(std::string* asked) {
  tinygltf::FsCallbacks none{};
  none.FileExists = [](const std::string& name, void* to) {
    *static_cast<std::string*>(to) = name.rfind("./", 0) == 0 ? name.substr(2) : name;
    return false;
  };
  none.ExpandFilePath = [](const std::string& name, void*) { return name; };
  none.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) {
    return false;
  };
  none.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&,
                           void*) { return false; };
  no_sizes(none, 0);
  none.user_data = asked;
  return none;
}

Soup read(const std::string& path) {
  const std::vector<unsigned char> bytes = bytes_of(path);
  const std::vector<std::string> unknown = check_extensions(bytes);
  tinygltf::TinyGLTF loader;
  std::string asked, error, warning;
  loader.SetFsCallbacks(no_files(&asked));
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  if (!loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                   static_cast<unsigned>(bytes.size()))) {
    if (!asked.empty())
      refuse(fmt::format("needs the file {} beside it; export as one .glb", asked));
    const std::string first = error.substr(0, error.find('\n'));
    refuse("no usable GLB file" + (first.empty() ? std::string() : ": " + first));
  }
  Soup soup = Reader(model).read();
  soup.extensions = unknown;
  return soup;
}

}  // namespace

Soup read_glb(const std::string& path) {
  try {
    return read(path);
  } catch (const std::bad_alloc&) {
    refuse(path + ": does not fit into the memory; decimate it first");
  } catch (const std::exception& error) {
    std::string what = error.what();
    // A message may have bytes of the file in it.
    std::replace_if(
        what.begin(), what.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    if (what.find("; ") == std::string::npos) what += "; export it again as binary glTF, .glb";
    refuse(path + ": " + what);
  }
}

double place(Soup& soup, const Placing& placing) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec3 low{far, far, far}, high{-far, -far, -far};
  // A vertex that no triangle has does not count.
  for (const Triangle& t : soup.triangles) {
    for (const std::uint32_t n : t) {
      const Vec3 v = soup.at[n];
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
  }
  const Vec3 side = high - low, middle = 0.5 * (low + high);
  const double largest_m = std::max({side.x, side.y, side.z});
  if (!(largest_m > 0) || !std::isfinite(largest_m))
    refuse("the mesh has no extent; export a mesh that has triangles with an area");
  const bool moves = placing.size_m > 0;
  const double scale = moves ? placing.size_m / largest_m : 1;
  for (Vec3& v : soup.at) {
    if (moves) v = placing.centre_m + scale * (v - middle);
  }
  const Vec3 from = moves ? placing.centre_m - 0.5 * scale * side : low;
  const Vec3 to = moves ? placing.centre_m + 0.5 * scale * side : high;
  const double farthest_m = std::max({-from.x, -from.y, -from.z, to.x, to.y, to.z});
  if (!(farthest_m <= reach_m)) {
    refuse(
        fmt::format("the mesh reaches {:.3g} m from the middle and the pen {} m; make it smaller "
                    "with --size, or move it with --centre",
                    farthest_m, reach_m));
  }
  return scale;
}

}  // namespace feltgate::touch
