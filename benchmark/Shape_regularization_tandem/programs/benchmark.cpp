// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The benchmark: Tandem beside its peers, by the paper's criteria and experiments.
// tandem_benchmark --help explains it; scripts/benchmark.sh runs all of it.

#include "experiments/Experiment.h"

#include <boost/program_options.hpp>

#include <iomanip>
#include <iostream>
#include <sstream>

namespace po = boost::program_options;
using namespace CGAL::Tandem::benchmark;

namespace {

struct Command_line {
  std::string experiment, contestants;
  Experiment_options options;
  std::string help; // if it is wanted
};

std::string help(const po::options_description& options)
{
  std::ostringstream text;
  text << "tandem_benchmark SUBCOMMAND [options] [ARGUMENT...]\n\nSubcommands:\n";
  for(const Experiment& e : experiments())
    text << "  " << std::left << std::setw(12) << e.name << e.help << "\n";
  text << "\nContestants:\n";
  for(const Contestant& c : contestants())
    text << "  " << std::left << std::setw(24) << c.name << c.description << "\n";
  text << "\n" << options;
  return text.str();
}

po::options_description make_stage_parameters(Command_line& line)
{
  Experiment_options& o = line.options;
  po::options_description visible("Options");
  visible.add_options()("help", "this text")("quick", po::bool_switch(&o.is_quick), "small clouds, few steps")(
    "output", po::value(&o.output)->default_value("."), "folder of what is written; it exists")(
    "data", po::value(&o.data), "folder of the clouds of clouds.csv that are files")(
    "repeats", po::value(&o.repeats)->default_value(3), "runs that are timed")(
    "threads", po::value(&o.threads)->default_value(0), "of parallel contestants; 0: all processors")(
    "simplicity", po::value(&o.simplicity), "of Tandem, for `labels`")("regularity", po::value(&o.regularity),
                                                                       "likewise")(
    "contestants", po::value(&line.contestants), "names, separated by commas; default: as the subcommand has them");
  return visible;
}

// The arguments that boost shall not take for options are numbers such as -1.
Command_line parse(int argc, char** argv)
{
  Command_line line;
  const po::options_description visible = make_stage_parameters(line);
  po::options_description all;
  all.add(visible).add_options()("subcommand", po::value(&line.experiment))("argument",
                                                                            po::value(&line.options.arguments));
  po::positional_options_description positions;
  positions.add("subcommand", 1).add("argument", -1);
  const int style = po::command_line_style::default_style & ~po::command_line_style::allow_short;
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(positions).style(style).run(), values);
  po::notify(values);
  if(values.count("help") || line.experiment.empty())
    line.help = help(visible);
  std::istringstream names(line.contestants);
  for(std::string name; std::getline(names, name, ',');)
    line.options.contestants.push_back(name);
  return line;
}

void check(const Experiment_options& o)
{
  if(o.repeats == 0)
    throw std::invalid_argument("--repeats must be at least 1");
  for(const std::string& name : o.contestants)
    contestant(name);
}

void run(const Command_line& line)
{
  for(const Experiment& e : experiments())
    if(line.experiment == e.name) {
      check(line.options);
      e.run(line.options);
      return;
    }
  throw std::invalid_argument("unknown subcommand " + line.experiment);
}

} // namespace

int main(int argc, char** argv)
try {
  const Command_line line = parse(argc, argv);
  if(line.help.empty())
    run(line);
  else
    std::cout << line.help;
  return 0;
} catch(const std::exception& e) {
  std::cerr << "tandem_benchmark: " << e.what() << " (tandem_benchmark --help lists the options)\n";
  return 1;
}
