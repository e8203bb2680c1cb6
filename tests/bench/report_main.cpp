// fpz-speed-report: errors and times of the integrators; see docs/speed-vs-error.md.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "fpz/io/markdown.hpp"
#include "fpz/io/output.hpp"
#include "pictures.hpp"
#include "report.hpp"

namespace {

using namespace fpz::bench;

int quick() {
  Results r;
  for (const Case<2>& c : {four_stage_case(), mixed_case(), compressive_case()}) r.paths.push_back(study_path(c, true));
  r.coarse_implicit = study_coarse_implicit();
  r.tolerance = study_tolerance(true);
  bool ok = true;
  for (const Target& t : accuracy_targets(r)) {
    std::cout << (t.met ? "PASS  " : "FAIL  ") << t.what << ": " << t.reached << " (wanted: " << t.wanted << ")\n";
    ok = ok && t.met;
  }
  for (const ToleranceRow& row : r.tolerance) {
    std::cout << (row.met() ? "PASS  " : "FAIL  ") << row.path << ", " << row.tolerance << ":";
    for (const auto& e : row.at) std::cout << ' ' << (e.ok() ? sci(e.worst()) : to_string(e.status));
    std::cout << '\n';
  }
  return ok ? 0 : 1;
}

int full(const std::filesystem::path& folder) {
  const std::filesystem::path images = folder / "images";
  std::filesystem::create_directories(images);
  const double start = cpu_seconds();
  const auto progress = [&](const char* what) {
    std::cerr << "[" << static_cast<int>(cpu_seconds() - start) << " s] " << what << '\n';
  };
  Results r;
  progress("times of single updates");
  r.timings = study_timings();
  for (const Case<2>& c : {four_stage_case(), mixed_case(), compressive_case()}) {
    progress(("path: " + c.title).c_str());
    r.paths.push_back(study_path(c, false));
  }
  progress("time to a given error");
  r.time_to_error = study_time_to_error(four_stage_case(), target_error);
  progress("requested against achieved");
  r.tolerance = study_tolerance(false);
  r.coarse_implicit = study_coarse_implicit();
  progress("onset");
  r.onset = study_onset();
  progress("iso-error maps");
  r.maps = study_maps();
  progress("residual histories");
  r.newton = study_newton();
  progress("alternatives");
  r.alternatives = study_alternatives();
  progress("pictures");
  draw_increment(r.paths, images);
  draw_time(r.paths, images);
  draw_tolerance(r.tolerance, images);
  draw_onset(r.onset, images);
  draw_maps(r.maps, images);
  draw_newton(r.newton, images);
  draw_alternatives(r.alternatives, images);
  std::ostringstream page;
  write_report(page, r);
  fpz::io::write_text(folder / "speed-vs-error.md", fpz::io::wrap_prose(page.str()), true);
  progress("done");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Error and time of the integrators: writes speed-vs-error.md and its pictures"};
  std::string folder;
  bool reduced = false;
  auto* output = app.add_option("-o,--output", folder, "folder of the report; pictures go to its subfolder images");
  auto* quick_flag =
      app.add_flag("--quick", reduced, "check the errors on a reduced set, write nothing; exit 1 on a miss");
  output->excludes(quick_flag);
  CLI11_PARSE(app, argc, argv);
  if (!reduced && folder.empty()) {
    std::cerr << "give -o FOLDER or --quick\n";
    return 2;
  }
  try {
    return reduced ? quick() : full(folder);
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
