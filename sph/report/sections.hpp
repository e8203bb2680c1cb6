// The sections of the report. Each writes its tables, pictures and what they say, for whatever has been run.
#pragma once

#include <ostream>

#include "drawing.hpp"
#include "results.hpp"

namespace fpz::report {

void write_beam(std::ostream& out, const Results& results, const Gallery& gallery);
void write_semicircular(std::ostream& out, const Results& results, const Gallery& gallery);
void write_ring(std::ostream& out, const Results& results, const Gallery& gallery);
void write_method(std::ostream& out, const Results& results, const Gallery& gallery);
void write_solvers(std::ostream& out, const Results& results, const Gallery& gallery);
void write_cost(std::ostream& out, const Results& results, const Gallery& gallery);

}  // namespace fpz::report
