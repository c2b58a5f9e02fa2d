// What the experiments of the catalog are put together from.
#pragma once

#include <string>
#include <vector>

#include "engine/experiment/experiment.h"

namespace quorum {

/// Runs of a scene with the paper's settings, with the program's defaults, and with the paper's windows along the axes.
RunSettings paper_run(const std::string& scene, std::string label);
RunSettings default_run(const std::string& scene, std::string label);
RunSettings axis_run(const std::string& scene, std::string label);

/// The pictures of some runs in rows: one row for each picture, one column for each run.
Figure rows_of_pictures(std::string name, const std::vector<std::size_t>& runs, const std::vector<Picture>& pictures,
                        const std::vector<std::string>& captions);

/// Experiments about what the paper leaves open, and about the program beside the paper.
Experiment window_model_experiment();
Experiment weights_experiment();
Experiment view_rule_experiment();
Experiment defaults_experiment();

}  // namespace quorum
