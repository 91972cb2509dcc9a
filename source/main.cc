#include "stockwork/base/blas.h"
#include "stockwork/base/command_line.h"
#include "stockwork/base/deck.h"
#include "stockwork/base/error.h"
#include "stockwork/base/lone_process.h"
#include "stockwork/base/parameters.h"
#include "stockwork/base/run_context.h"
#include "stockwork/base/version.h"

#include "base/catalogue.h"
#include "case.h"
#include "model_choice/model_choice.h"
#include "plug_ins.h"
#include "simulation.h"

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iomanip>
#include <iostream>

namespace stockwork
{

namespace
{
std::string output_directory_of(const Deck &deck, const PlugIns &plug_ins)
{
  dealii::ParameterHandler prm;
  declare_all_parameters(prm, plug_ins);
  deck.parse_into(prm);
  return prm.get("Output directory");
}


int run_program(const CommandLine &command_line, RunContext &run)
{
  PlugIns plug_ins = PlugIns::own();
  dealii::ParameterHandler prm;

  switch (command_line.action)
  {
  case CommandLine::Action::help:
    run.out << help_text();
    return 0;
  case CommandLine::Action::version:
    run.out << version_report();
    return 0;
  case CommandLine::Action::list:
    if (run.rank == 0)
    {
      std::cout << "Fracture models\n";
      for (const auto &[name, entry] : plug_ins.fracture_models.all())
        std::cout << "  " << std::left << std::setw(32) << name << ' ' << entry.description << '\n';
      std::cout << '\n';
      print_cases(std::cout);
    }
    return 0;
  case CommandLine::Action::print_parameters:
    if (command_line.deck.empty())
    {
      declare_all_parameters(prm, plug_ins);
      if (run.rank == 0)
        print_parameters(prm, command_line.parameter_format, std::cout);
      return 0;
    }
    break;
  default:
    break;
  }

  std::vector<std::string> overrides = command_line.overrides;
  if (command_line.output)
    overrides.push_back("Output directory=" + *command_line.output);
  Deck deck = Deck::read(command_line.deck, overrides);
  SimulationOptions options;
  try
  {
    plug_ins.load(deck);
    if (leaves_model_to_program(deck))
      deck = choose_model(run, deck, overrides, plug_ins,
                          command_line.restart ? output_directory_of(deck, plug_ins) : "",
                          options.chosen);
    declare_all_parameters(prm, plug_ins);
    deck.parse_into(prm);
    if (command_line.action == CommandLine::Action::print_parameters)
    {
      if (run.rank == 0)
        print_parameters(prm, command_line.parameter_format, std::cout);
      return 0;
    }

    // An effective deck spells the default out.
    if (const std::string accuracy = prm.get("Accuracy");
        accuracy != "2 %" && options.chosen.empty() && prm.get("Physics") != "auto")
      run.warn("'Accuracy = " + accuracy +
               "' is without effect: none of 'Physics', 'Fracture/Model' and 'Resolution' is "
               "'auto'.");
    options.deck = std::filesystem::absolute(command_line.deck).string();
    options.output_directory = prm.get("Output directory");
    options.check_only = command_line.action == CommandLine::Action::check;
    options.restart = command_line.restart;
    if (prm.get("Dimension") == "2")
      simulate<2>(run, deck, prm, plug_ins, options);
    else
      simulate<3>(run, deck, prm, plug_ins, options);
  }
  catch (const EntryError &error)
  {
    throw InputError(deck.located(error));
  }
  return 0;
}
} // namespace
} // namespace stockwork


int main(int argc, char **argv)
{
  using namespace stockwork;
  start_lone_process_quickly();
  choose_blas_for_processor();
  // The options are ours: newer PETSc, which deal.II starts, complains of those that it does not
  // know.
  int n_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_arguments, argv, 1);
  RunContext run(MPI_COMM_WORLD);

  // A failure is the same on all ranks, or the others would wait for ever: rank 0 speaks, and the
  // whole job ends.
  const auto fail = [&](const int status, const std::string &message)
  {
    if (run.rank == 0)
      std::cerr << message << std::endl;
    return status;
  };
  try
  {
    return run_program(parse_command_line(argc, argv), run);
  }
  catch (const InputError &error)
  {
    return fail(1, error.what());
  }
  catch (const SolveError &error)
  {
    return fail(2, error.what());
  }
  catch (const OutputError &error)
  {
    return fail(2, error.what());
  }
  catch (const std::exception &error)
  {
    std::cerr << "stockwork stopped on rank " << run.rank << ": " << error.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 2);
    return 2;
  }
}
