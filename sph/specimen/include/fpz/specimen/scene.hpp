// A scene: what a fracture test of a specimen consists of, as read from a JSON file (docs/scenes.md).
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fpz/io/csv.hpp"
#include "fpz/io/json_locator.hpp"
#include "fpz/parameters.hpp"
#include "fpz/specimen/gauge.hpp"
#include "fpz/specimen/loading.hpp"
#include "fpz/specimen/placing.hpp"
#include "fpz/specimen/solver.hpp"
#include "fpz/specimen/strength_field.hpp"
#include "fpz/specimen/toughness.hpp"
#include "fpz/sph/options.hpp"

namespace fpz::specimen {

/// Particles from a file instead of a pattern (docs/scenes.md, "Particles from a file").
struct ParticleFile {
  std::filesystem::path file;
  io::CsvOptions notation = {};  ///< of a CSV file, where it does not say itself
};

/// A group of boundary particles and how it moves.
struct Boundary {
  std::string name;
  std::optional<Platen> platen;  ///< none: its particles come from the particle file
  std::vector<Point> also_at;    ///< further places of the platen, whose particles move as one with it
  Actuations drive;              ///< per component; none: free
  bool elastic = true;
  bool rigid = false;        ///< all its particles have one velocity in free components too
  std::size_t material = 0;  ///< number, see Scene::further_materials
  /// It turns freely as a rigid body about a point: this one, or where none is given the middle of its foot.
  bool hinged = false;
  std::optional<Point> hinge;
};

/// The platen of a boundary in all its places; empty for one of a particle file.
[[nodiscard]] std::vector<Platen> platens_of(const Boundary& boundary);

/// A material besides that of the scene.
struct SceneMaterial {
  std::string name;
  Parameters parameters;  ///< rve_length is 0
};

/// A part of the body that is of another material.
struct Region {
  std::string name;
  std::size_t material = 0;   ///< number, see Scene::further_materials
  std::vector<Shape> shapes;  ///< together; none: the particle file says which particles are in it
};

/// Parallel planes.
struct Bedding {
  double angle = 0.0;            ///< radian, of their traces, counter-clockwise from +x
  double spacing = 0.0;          ///< m, from plane to plane
  Point origin = Point::Zero();  ///< on one of them
};

/// Planes on which the body cracks at a strength of their own: along a line, or bedding throughout the body.
struct Interface {
  std::string name;
  Parameters material;  ///< elasticity and density have no effect: they are those of what is beside it
  std::vector<Point> line;
  std::optional<Bedding> bedding;  ///< in place of a line
};

/// A gauge beyond a value.
struct GaugeLimit {
  std::string gauge;
  bool above = true;
  double value = 0.0;
};

/// When a stage ends. The time always counts; the others when they are given.
struct StopRules {
  double time = 0.0;                 ///< s, of the stage
  std::optional<double> deflection;  ///< m
  std::optional<double> load_below;  ///< fraction of the peak, once something has cracked
  bool separation = false;           ///< the specimen is in two pieces
  std::vector<GaugeLimit> gauges;
  std::optional<double> kinetic_below;  ///< kinetic over elastic energy: at rest
};

/// What changes when a stage begins, and when it ends. What the first one changes is in the boundaries, loads and
/// options of the scene.
struct Stage {
  std::string name;
  std::vector<std::pair<std::size_t, Actuations>> boundaries;  ///< index, and the components that change
  std::vector<std::pair<std::size_t, TimeCourse>> loads;       ///< index, and how its value goes on
  std::optional<double> damping;
  StopRules stop;
};

struct OutputRules {
  int history_rows = 1000;        ///< over the whole time
  int frames = 40;                ///< VTU files over the whole time; 0: none but those at `frames_at`
  std::vector<double> frames_at;  ///< deflections, m, at which one more is written
  std::vector<double> picture_loads = {1.0, -0.7, -0.4,
                                       -0.1};  ///< moments drawn: fractions of the peak load, negative after it
  double checkpoint_seconds = 60.0;            ///< of wall time; 0: none
  bool pictures = true;
};

struct Scene {
  std::string file;  ///< where it was read from, for messages
  std::string name;
  std::string description;
  std::string material_name;
  Parameters parameters;                         ///< rve_length is 0: method.rve_length decides
  std::vector<SceneMaterial> further_materials;  ///< of regions, then of boundaries: numbers 1, 2, ...
  std::vector<Region> regions;                   ///< later ones cover earlier ones
  std::vector<SceneMaterial> interface_materials;
  std::vector<Interface> interfaces;  ///< later ones go before earlier ones
  std::optional<StrengthField> strength_field;
  Setting setting = Setting::plane_strain;
  double thickness = 0.0;  ///< m
  double spacing = 0.0;    ///< m
  Body body;
  bool has_shape = false;  ///< false: particles from a file alone
  Pattern pattern;
  std::optional<ParticleFile> particles;
  std::vector<Boundary> boundaries;
  std::vector<SurfaceLoad> loads;
  std::optional<Tensor<double, 2>> initial_stress;  ///< xx, yy, xy, Pa; everywhere
  sph::Options<2> options;
  Solver solver;
  std::map<std::string, Gauge> gauges;  ///< "load" and "deflection" are always there
  std::optional<SemicircularBending> toughness;
  std::vector<Stage> stages;  ///< at least one
  StopRules stop;             ///< of the last stage; its time is that of all stages
  OutputRules output;

  std::vector<std::string> warnings;     ///< doubtful but admissible
  std::vector<std::string> conversions;  ///< parameters of materials that follow from other quantities, in words
  std::string text;  ///< the complete scene as JSON, overrides applied, material inline: reads back as the same scene
};

/// `path=value`, as in "method.courant=0.3" or "notches[0].angle_deg=30". The value is JSON; anything else is a string.
using Overrides = std::vector<std::string>;

/// Reads a scene. Throws io::InputError with all problems, each with file, line, key path and nearest valid name.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file, const Overrides& overrides = {});
[[nodiscard]] Scene parse_scene(std::string_view text, const std::filesystem::path& origin,
                                const Overrides& overrides = {});

/// Sets one entry of a JSON tree; members that do not exist are added. Problems are added for a malformed override or a
/// path that leads through something else than objects and arrays.
void apply_override(io::JsonValue& root, const std::string& assignment, const std::string& file,
                    io::Problems& problems);

/// A tree as JSON text, two spaces per level, numbers as they were spelt.
[[nodiscard]] std::string to_text(const io::JsonValue& root);

}  // namespace fpz::specimen
