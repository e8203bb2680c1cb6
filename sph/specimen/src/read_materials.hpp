// The materials of a scene: its own, and those of regions and boundaries, which may say what differs from it.
#pragma once

#include "fpz/io/material_file.hpp"
#include "scene_reader.hpp"

namespace fpz::specimen::detail {

/// The material of the scene. In the tree the content of a file takes the place of its name, so that the text of the
/// scene reads back the same.
[[nodiscard]] std::optional<io::MaterialFile> read_material_of_scene(const InputReader& r, JsonValue& root);

/// Adds how its parameters follow from what is stated to those of the scene.
void note_conversions(const io::MaterialFile& material, Scene& scene);

/// Reads the materials of the entries of an array of the root: the name of a file, or an object with what differs from
/// the file that it names, or else from `first`, the material of the scene; without that none is read. In the tree they
/// become complete. They are appended to `all`, with warnings about them where they may crack. Their
/// numbers in `all`, from 1 on, by entry; 0 where an entry has none.
[[nodiscard]] std::vector<std::size_t> add_materials(const InputReader& r, JsonValue& root, std::string_view array,
                                                     const JsonValue* first, bool may_crack, Scene& scene,
                                                     std::vector<SceneMaterial>& all);

}  // namespace fpz::specimen::detail
