// Meshes of gmsh, ASCII, file format 2 and 4.
#include <map>
#include <sstream>

#include "fpz/io/input_error.hpp"
#include "plane_mesh.hpp"

namespace fpz::specimen::detail {
namespace {

using io::InputError;

/// Element types by their number: what of their nodes are corners.
struct ElementType {
  int nodes = 0;
  int corners = 0;  ///< 1: a point, 2: a line, 3 and 4: cells
};
const std::map<int, ElementType> element_types = {{15, {1, 1}},  {1, {2, 2}}, {8, {3, 2}},  {2, {3, 3}},  {9, {6, 3}},
                                                  {21, {10, 3}}, {3, {4, 4}}, {10, {9, 4}}, {16, {8, 4}}, {26, {4, 2}}};

class GmshReader {
 public:
  GmshReader(const std::string& text, std::string file) : in_(text), file_(std::move(file)) {}

  PlaneMesh read() {
    for (std::string word; in_ >> word;) {
      if (word == "$MeshFormat") read_format();
      if (word == "$Nodes") old_ ? read_nodes_2() : read_nodes_4();
      if (word == "$Elements") old_ ? read_elements_2() : read_elements_4();
    }
    if (mesh_.nodes.empty()) throw InputError(file_ + ": has no $Nodes; must be a mesh of gmsh (.msh)");
    double size = 0.0;
    for (const Point& x : mesh_.nodes) size = std::max(size, x.cwiseAbs().maxCoeff());
    require_flat(z_, size, file_);
    return std::move(mesh_);
  }

 private:
  template <class T>
  T next(const char* what) {
    T value{};
    if (!(in_ >> value)) {
      throw InputError(file_ + ": ends early, or has no number, where " + what + " should be");
    }
    return value;
  }
  std::size_t count(const char* what) { return next<std::size_t>(what); }

  void read_format() {
    const auto version = next<double>("the version");
    const int binary = next<int>("the file type");
    if (!((version >= 2.0 && version < 3.0) || (version >= 4.0 && version < 5.0))) {
      throw InputError(file_ + ": $MeshFormat " + std::to_string(version) + ": must be version 2.2 or 4.1");
    }
    if (binary != 0) {
      throw InputError(file_ + ": is binary; must be ASCII (in gmsh: Mesh.Binary = 0, or without -bin)");
    }
    old_ = version < 3.0;
  }

  void add_node(std::size_t tag) {
    const auto x = next<double>("a coordinate"), y = next<double>("a coordinate");
    z_.push_back(next<double>("a coordinate"));
    index_[tag] = mesh_.nodes.size();
    mesh_.nodes.emplace_back(x, y);
  }

  void read_nodes_2() {
    const std::size_t n = count("the number of nodes");
    for (std::size_t k = 0; k < n; ++k) add_node(count("the number of a node"));
  }

  void read_nodes_4() {
    const std::size_t blocks = count("the number of blocks");
    for (int k = 0; k < 3; ++k) (void)count("the range of nodes");
    for (std::size_t b = 0; b < blocks; ++b) {
      const int dimension = next<int>("a dimension");
      (void)next<int>("an entity");
      const int parametric = next<int>("a flag");
      std::vector<std::size_t> tags(count("the number of nodes"));
      for (std::size_t& tag : tags) tag = count("the number of a node");
      for (const std::size_t tag : tags) {
        add_node(tag);
        for (int k = 0; parametric != 0 && k < dimension; ++k) (void)next<double>("a parameter");
      }
    }
  }

  void add_element(int type) {
    const auto known = element_types.find(type);
    if (known == element_types.end()) {
      throw InputError(file_ + ": has elements of type " + std::to_string(type) +
                       "; must have lines, triangles and quadrilaterals only: a mesh of the plane");
    }
    std::vector<std::size_t> corners;
    for (int k = 0; k < known->second.nodes; ++k) {
      const std::size_t tag = count("a node of an element");
      if (k >= known->second.corners) continue;
      const auto at = index_.find(tag);
      if (at == index_.end()) {
        throw InputError(file_ + ": an element has node " + std::to_string(tag) + ", which $Nodes does not have");
      }
      corners.push_back(at->second);
    }
    if (corners.size() == 2) mesh_.lines.push_back({corners[0], corners[1]});
    if (corners.size() > 2) mesh_.cells.push_back(corners);
  }

  void read_elements_2() {
    const std::size_t n = count("the number of elements");
    for (std::size_t k = 0; k < n; ++k) {
      (void)count("the number of an element");
      const int type = next<int>("the type of an element");
      const std::size_t tags = count("the number of tags");
      for (std::size_t t = 0; t < tags; ++t) (void)next<int>("a tag");
      add_element(type);
    }
  }

  void read_elements_4() {
    const std::size_t blocks = count("the number of blocks");
    for (int k = 0; k < 3; ++k) (void)count("the range of elements");
    for (std::size_t b = 0; b < blocks; ++b) {
      (void)next<int>("a dimension");
      (void)next<int>("an entity");
      const int type = next<int>("the type of elements");
      const std::size_t n = count("the number of elements");
      for (std::size_t k = 0; k < n; ++k) {
        (void)count("the number of an element");
        add_element(type);
      }
    }
  }

  std::istringstream in_;
  std::string file_;
  bool old_ = false;
  std::map<std::size_t, std::size_t> index_;  ///< of nodes, by their number in the file
  std::vector<double> z_;
  PlaneMesh mesh_;
};

}  // namespace

PlaneMesh read_gmsh(const std::string& text, const std::string& file) { return GmshReader(text, file).read(); }

}  // namespace fpz::specimen::detail
