#include "output/field_output.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "output/bulk_fields.h"
#include "output/checked_data.h"
#include "output/directory.h"
#include "output/fracture_fields.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
using namespace dealii;

namespace
{
/// Takes what the model adds.
template <int dim>
class Collector : public FieldSink<dim>
{
public:
  void add_cell_field(const std::string &name, const std::vector<double> &values) override
  {
    cell_fields.emplace_back(name, Vector<double>(values.begin(), values.end()));
  }

  void add_fracture_piece(const std::vector<Point<dim>> &corners,
                          const std::vector<std::pair<std::string, double>> &values) override
  {
    pieces.push_back({corners, values});
  }

  void add_bond(const Point<dim> &from,
                const Point<dim> &to,
                const std::vector<std::pair<std::string, double>> &values) override
  {
    bonds.push_back({{from, to}, values});
  }

  std::vector<std::pair<std::string, Vector<double>>> cell_fields;
  std::vector<FracturePiece<dim>> pieces, bonds;
};
} // namespace

template <int dim>
void FieldOutput<dim>::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Output");
  prm.declare_entry("Fields", "true", Patterns::Bool(), "Write fields for ParaView (.vtu, .pvd).");
  prm.declare_entry(
    "Steps between fields", "10", Patterns::Integer(0),
    "Write the fields after so many steps; 0: at the given times and the end only.");
  prm.declare_entry("Times of fields", "", Quantities(dimension::time, Range::finite()),
                    "Write the fields at these times, too; steps end there.");
  prm.declare_entry("Higher order cells", "true", Patterns::Bool(),
                    "Write quadratic elements as such (VTK's Lagrange cells) instead of four, or "
                    "eight, linear ones.");
  prm.leave_subsection();
}

template <int dim>
void FieldOutput<dim>::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Output");
  enabled = prm.get_bool("Fields");
  steps_between = prm.get_integer("Steps between fields");
  times = get_quantities(prm, "Times of fields", dimension::time);
  std::sort(times.begin(), times.end());
  higher_order_cells = prm.get_bool("Higher order cells");
  prm.leave_subsection();
}

template <int dim>
void FieldOutput<dim>::open(const std::string &output_directory, MPI_Comm mpi_communicator)
{
  directory = output_directory;
  communicator = mpi_communicator;
  prepare_output_directory(enabled ? directory + "/vtu" : directory, communicator);
}

template <int dim>
bool FieldOutput<dim>::due(const unsigned int step, const double time, const bool is_last) const
{
  if (!enabled)
    return false;
  return is_last || (steps_between > 0 && step % steps_between == 0) ||
         next_time(last_time) <= time * (1. + 1e-12);
}

template <int dim>
double FieldOutput<dim>::next_time(const double time) const
{
  for (const double t : times)
    if (enabled && t > time + 1e-12 * std::abs(time))
      return t;
  return std::numeric_limits<double>::infinity();
}

template <int dim>
std::vector<double> FieldOutput<dim>::times_outside(const double start, const double end) const
{
  std::vector<double> outside;
  const double slack = 1e-9 * (end - start);
  for (const double t : times)
    if (!(t > start) || t > end + slack)
      outside.push_back(t);
  return outside;
}

namespace
{
/// Each rank its own cells and, of several, the first one the list of the files.
/// @return the name of the whole, from @p directory
template <int dim>
std::string write_bulk(const DataOut<dim> &output,
                       const std::string &name,
                       const std::string &directory,
                       const MPI_Comm communicator)
{
  const unsigned int rank = Utilities::MPI::this_mpi_process(communicator),
                     n_ranks = Utilities::MPI::n_mpi_processes(communicator);
  std::vector<std::string> pieces{name + ".vtu"};
  if (n_ranks > 1)
  {
    pieces.clear();
    for (unsigned int r = 0; r < n_ranks; ++r)
      pieces.push_back(name + "." + std::to_string(r) + ".vtu");
  }
  on_all(communicator,
         [&]()
         {
           std::ostringstream stream;
           output.write_vtu(stream);
           write_file(directory + "/vtu/" + pieces[rank], stream.str(), OnDisk::soon);
         });
  const std::string whole = "vtu/" + name + (n_ranks > 1 ? ".pvtu" : ".vtu");
  if (n_ranks > 1)
    on_root(communicator,
            [&]()
            {
              std::ostringstream stream;
              output.write_pvtu_record(stream, pieces);
              write_file(directory + "/" + whole, stream.str(), OnDisk::soon);
            });
  return whole;
}
} // namespace


namespace
{
/// How constants of the rock vary from place to place, cell by cell, by name:
/// "young_modulus_factor", that by which the deck's value is multiplied.
template <int dim>
std::vector<std::pair<std::string, Vector<float>>>
random_fields(const Triangulation<dim> &triangulation, const Rock &rock)
{
  std::vector<std::pair<std::string, Vector<float>>> fields;
  for (unsigned int p = 0; p < RandomField::n_properties; ++p)
  {
    const auto property = static_cast<RandomField::Property>(p);
    if (!rock.varies(property))
      continue;
    std::string name = RandomField::name(property);
    std::replace(name.begin(), name.end(), ' ', '_');
    name[0] = std::tolower(name[0]);
    Vector<float> values(triangulation.n_active_cells());
    values = 1.;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (const RockProperties &here = rock(cell->material_id());
          cell->is_locally_owned() && here.is_random())
        values(cell->active_cell_index()) = here.random->factors(cell->center())[property];
    fields.emplace_back(name + "_factor", values);
  }
  return fields;
}
} // namespace


template <int dim>
void FieldOutput<dim>::write(const double time,
                             const MeshView<dim> &mesh_view,
                             const Scene<dim> &scene,
                             const FractureModel<dim> &model,
                             const State &state,
                             const NonlinearRock<dim> *nonlinear,
                             const NodalFields<dim> *own_fields)
{
  Collector<dim> collector;
  model.write_fields(state, collector);
  const unsigned int degree = mesh_view.dof_handler.get_fe().degree;

  CheckedData<DataOut<dim>> output;
  output.attach_dof_handler(mesh_view.dof_handler);
  const BulkFields<dim> fields(mesh_view, scene, model, state, nonlinear);
  output.add_data_vector(state.current.bulk, fields);
  for (unsigned int f = 0; own_fields != nullptr && f < own_fields->names.size(); ++f)
    output.add_data_vector(own_fields->dof_handler(), (*own_fields)[f], own_fields->names[f]);
  Vector<float> region(mesh_view.triangulation.n_active_cells());
  for (const auto &cell : mesh_view.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      region(cell->active_cell_index()) = cell->material_id();
  output.add_data_vector(region, "region");
  const auto of_rock = random_fields(mesh_view.triangulation, scene.rock);
  for (const auto &field : of_rock)
    output.add_data_vector(field.second, field.first, DataOut<dim>::type_cell_data);
  for (const auto &field : collector.cell_fields)
    output.add_data_vector(field.second, field.first, DataOut<dim>::type_cell_data);

  DataOutBase::VtkFlags flags;
  flags.print_date_and_time = false;
  flags.compression_level = decltype(flags.compression_level)::best_speed;
  flags.write_higher_order_cells = higher_order_cells && degree > 1;
  output.set_flags(flags);
  output.build_patches(mesh_view.mapping, degree, DataOut<dim>::curved_boundary);

  for (const std::string &bad : Utilities::MPI::all_gather(communicator, output.first_not_finite()))
    if (!bad.empty())
      throw SolveError("The field " + bad + " has a value that is not a number at t = " +
                       to_string(time, dimension::time) + ".");
  const std::string fracture = fracture_file(collector.pieces, communicator);
  const std::string bonds = bond_file(collector.bonds, communicator);
  const auto exists = [&](const std::string &text)
  { return Utilities::MPI::broadcast(communicator, text.empty() ? 0 : 1, 0) == 1; };
  const bool has_fracture = exists(fracture), has_bonds = exists(bonds);

  const std::string number = Utilities::int_to_string(bulk_records.size(), 4);
  const std::string bulk_file = write_bulk(output, "fields_" + number, directory, communicator);
  const std::string fracture_name = "vtu/fracture_" + number + ".vtu",
                    bonds_name = "vtu/bonds_" + number + ".vtu";
  on_root(communicator,
          [&]()
          {
            if (has_fracture)
              write_file(directory + "/" + fracture_name, fracture, OnDisk::soon);
            if (has_bonds)
              write_file(directory + "/" + bonds_name, bonds, OnDisk::soon);
          });

  // Only what is complete goes into the series.
  bulk_records.emplace_back(time, bulk_file);
  if (has_fracture)
    fracture_records.emplace_back(time, fracture_name);
  if (has_bonds)
    bond_records.emplace_back(time, bonds_name);
  last_time = time;
  on_root(communicator,
          [&]()
          {
            write_pvd("fields.pvd", bulk_records);
            if (has_fracture)
              write_pvd("fracture.pvd", fracture_records);
            if (has_bonds)
              write_pvd("bonds.pvd", bond_records);
          });
}

template <int dim>
void FieldOutput<dim>::write_pvd(const std::string &name, const Records &records) const
{
  std::ostringstream stream;
  DataOutBase::write_pvd_record(stream, records);
  replace_file(directory + "/" + name, stream.str(), OnDisk::soon);
}

template class FieldOutput<2>;
template class FieldOutput<3>;
} // namespace stockwork
