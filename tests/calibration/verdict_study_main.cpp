// Writes docs/verdict-study.csv: the verdicts on 200 synthetic beams. fpz-verdict-study FILE [beams]
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "fpz/io/output.hpp"
#include "verdict_study.hpp"

namespace {

using namespace fpz::calibration;  // NOLINT(google-build-using-namespace): a main file

struct Counts {
  int accepted_right = 0, accepted_wrong = 0, refused_right = 0, refused_wrong = 0;

  void count(const test::StudyOutcome& o) {
    const bool accepted = o.status == FitStatus::ok;
    ++(accepted ? (o.right ? accepted_right : accepted_wrong) : (o.right ? refused_right : refused_wrong));
  }

  void print(const char* which) const {
    std::printf("%s: accepted and right %d, accepted and wrong %d, refused though right %d, refused and wrong %d\n",
                which, accepted_right, accepted_wrong, refused_right, refused_wrong);
  }
};

std::string columns(const test::StudyOutcome& o) {
  char text[80];
  std::snprintf(text, sizeof text, ",%s,%.2f,%s", std::string(fpz::to_string(o.status)).c_str(), o.deviation,
                o.right ? "right" : "wrong");
  return text;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: fpz-verdict-study FILE [beams]\n");
    return 2;
  }
  const int beams = argc > 2 ? std::atoi(argv[2]) : 200;
  std::string text =
      "# Synthetic notched beams: four starts, the first 40 % off; and one start, five times off. Deviations from the "
      "truth in standard errors.\nbeam,points,noise,softening,zone_over_ligament,verdict,deviation,truth,"
      "far_verdict,far_deviation,far_truth\n";
  Counts near, far;
  for (int k = 0; k < beams; ++k) {
    const test::StudyBeam beam = test::study_beam(static_cast<std::uint64_t>(k));
    const test::StudyOutcome a = test::study_fit(beam, 1.4, 4);
    const test::StudyOutcome b = test::study_fit(beam, 5.0, 1);
    near.count(a);
    far.count(b);
    const double zone =
        beam.truth.young_modulus * beam.truth.delta0 / beam.truth.tensile_strength / beam.specimen.ligament();
    char line[120];
    std::snprintf(line, sizeof line, "%d,%d,%g,%s,%.2f", k, static_cast<int>(beam.cmod.size()), beam.noise,
                  k % 4 == 3 ? "bilinear" : "exponential", zone);
    text += line + columns(a) + columns(b) + '\n';
    std::fprintf(stderr, "%s%s%s %s | %s\n", line, columns(a).c_str(), columns(b).c_str(), a.message.c_str(),
                 b.message.c_str());
  }
  fpz::io::write_text(argv[1], text, true);
  near.print("four starts");
  far.print("one start five times off");
  return near.accepted_wrong + near.refused_right + far.accepted_wrong == 0 ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "fpz-verdict-study: %s\n", e.what());
  return 2;
}
