#pragma once

#include <deal.II/base/array_view.h>
#include <deal.II/base/parameter_handler.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include "stockwork/exchange/cell_role.h"
#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/extra_unknown.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/segment.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"
#include "stockwork/fracture/explicit_rock.h"
#include "stockwork/fracture/kept_terms.h"
#include "stockwork/fracture/summary.h"
#include "stockwork/mesh/mesh_view.h"
#include "stockwork/mesh/nodal_fields.h"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// What a model can make of a rock whose regions have constants of their own.
enum class RegionalRock
{
  any,                 ///< it reads the constants of the region that it looks at
  of_uniform_strength, ///< it breaks all rock as it breaks outside of the regions
  none                 ///< its own terms know the rock outside of the regions alone
};

/// What a model needs of the others. What nobody asks for is never allocated.
struct Requirements
{
  bool pore_pressure = false; ///< cannot run in dry, elastic rock

  /// The elements of the pore pressure carry the fluid of the fractures, which has no pressure of
  /// its own.
  bool fluid_in_pores = false;

  bool symmetric = true; ///< its own terms keep the matrix symmetric

  /// One of the laws that role() may put in place of the rock's; all of them have its history.
  /// Null: there are none. It lives as long as the model.
  const RockLaw *law = nullptr;

  bool has_fracture = true; ///< else neither unknowns nor segments, ever
  bool may_grow = true;     ///< else its cracks stay as long as the deck gives them
  RegionalRock regional_rock = RegionalRock::any;
  bool random_rock = false; ///< it reads the constants of the place that it looks at: Rock::at()

  /// What advance() breaks may count from the next step on, without a solve between: its response
  /// is linear wherever no jump exceeds those that it has committed.
  bool breaks_between_steps = false;

  /// wanted_cell_size() speaks for every cell that is to stay small: others may be merged.
  bool lets_cells_merge = false;

  /// For the estimate before a run: the time of a step in dry rock in that of cut cells with as
  /// many unknowns, and what the model itself keeps [bytes per unknown].
  double time_of_step = 1.;
  double memory_per_unknown = 0.;
};

/// What a model says about a converged solution.
struct Verdict
{
  enum class Kind
  {
    accept,
    topology_changed, ///< the fracture has grown: solve again at the same time
    reject,           ///< not admissible: the driver rolls back and cuts the step
    stop              ///< nor with any shorter step: the run ends at the last accepted one
  };
  Kind kind = Kind::accept;
  std::string reason; ///< of a step that is not accepted; said to the user

  // What the stepper makes the next step longer or shorter by, after one that is accepted.

  /// The most segments by which one tip has grown in the step. Nothing: no fracture has a say in
  /// how long steps are.
  std::optional<unsigned int> advances = std::nullopt;
  /// A tip would have grown on, but may not in one step.
  bool held_back = false;
  /// Attempts at the step have failed for another reason than its length.
  bool length_is_right = false;
};

/// A fracture model. Few functions are pure; a model overrides what it needs. The order of calls
/// within a time step is
///
///   begin_step; assemble… until converged; advance; commit or rollback
///
/// with everything after begin_step repeated while advance() reports a changed topology. `setup`
/// is called whenever the mesh has changed, never inside a step. A model owns no clock, no file
/// and no communicator. doc/architecture.md walks three models through a step.
///
/// A model that overrides commit() has a history, and overrides rollback(), save(), load() and
/// summary() as well: MadeModel (registry.h) takes no other.
template <int dim>
class FractureModel
{
public:
  using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;

  virtual ~FractureModel() = default;

  virtual Requirements requirements() const
  {
    return {};
  }

  /// The mesh or the numbering of the bulk unknowns is new.
  virtual void setup(const MeshView<dim> &, const Collectives &)
  {
  }

  /// Fields of the model's own, which move with the mesh, are saved and are written for people.
  /// Null: there are none, ever.
  virtual NodalFields<dim> *nodal_fields()
  {
    return nullptr;
  }

  virtual void begin_step(const StepContext &)
  {
  }

  /// The model's own unknowns, in the order of their indices, the same on every rank. Fluid
  /// pressures are not among them.
  virtual std::vector<ExtraUnknown> extra_unknowns() const
  {
    return {};
  }

  /// Locally owned segments.
  virtual dealii::ArrayView<const Segment<dim>> segments() const
  {
    return {};
  }

  /// How the bulk kernel shall treat a locally owned cell. It changes with setup() and with a
  /// changed topology only.
  virtual CellRole<dim> role(const CellIterator &) const
  {
    return {};
  }

  /// Terms that are linear in the bulk unknowns and stay as they are for many solves (bonds that
  /// hold). Null: there are none, ever.
  virtual const KeptTerms *kept_terms() const
  {
    return nullptr;
  }

  /// The rock, where 'Time/Scheme = explicit' asks for it; after setup(). Null: the model cannot.
  virtual ExplicitRock *explicit_rock()
  {
    return nullptr;
  }

  /// Add the model's other terms (cohesive tractions, released stress); not the fluid, not the
  /// bulk. A function of committed history and of the state alone, but for derivatives, see
  /// uses_secants(): it may be called any number of times.
  virtual void assemble(const StepContext &, const State &, Sink &) const
  {
  }

  /// Whether in the last assemble() derivatives were secants, as where forces fall faster than the
  /// rock around gives way: on the way on to where it holds, residuals grow for a while. On this
  /// rank.
  virtual bool uses_secants() const
  {
    return false;
  }

  /// The unknowns have converged: grow?
  virtual Verdict advance(const StepContext &, const State &, const Collectives &)
  {
    return {};
  }

  /// The step is accepted: trial history becomes history. Returns, on every rank alike, whether
  /// setup() shall be called before the next step even if the mesh stays as it is, for the part of
  /// it that the model works on has grown.
  virtual bool commit(const StepContext &, const State &)
  {
    return false;
  }

  /// The step is rejected: back to the state at begin_step, as if it had never been.
  virtual void rollback()
  {
  }

  /// Sentences for the user since the last call: values the model has chosen by itself, warnings, a
  /// tip that has stopped; nothing from a step that was rolled back. The same on every rank.
  virtual std::vector<std::string> take_messages()
  {
    return {};
  }

  /// Why entries of the model's own that are 'auto' in the deck are what they have come to, where
  /// there is more to say than that the deck's other entries ask for it. By entry.
  virtual std::map<std::string, std::string> reasons() const
  {
    return {};
  }

  /// That of the rock outside of regions, as the deck gives it or chosen for the cells; after
  /// setup() [Pa]. NaN: the model has none.
  virtual double tensile_strength() const
  {
    return std::numeric_limits<double>::quiet_NaN();
  }

  /// Lower the wanted size of cells (by active cell index, [m]) where the fracture is or may soon
  /// be. Called before the first setup(), when nothing but the scene's cracks is known, and between
  /// steps.
  virtual void wanted_cell_size(const dealii::parallel::distributed::Triangulation<dim> &,
                                std::vector<float> &) const
  {
  }

  virtual void save(boost::archive::binary_oarchive &) const
  {
  }

  virtual void load(boost::archive::binary_iarchive &)
  {
  }

  virtual FractureSummary summary(const State &, const Collectives &) const
  {
    return {};
  }

  virtual void write_fields(const State &, FieldSink<dim> &) const
  {
  }
};
} // namespace stockwork
