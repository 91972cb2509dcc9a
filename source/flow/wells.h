#pragma once

#include <deal.II/base/parameter_handler.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flow/fluid_balance.h"
#include "flow/network_segment.h"
#include "flow/point_source.h"
#include "flow/time_history.h"
#include "stockwork/base/error.h"
#include "stockwork/exchange/extra_unknown.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/sink.h"
#include "stockwork/exchange/state.h"

namespace stockwork
{
/// What a well did in a step.
struct WellReport
{
  std::string name;
  double rate = 0.;                      ///< into the model, at the well head [m^3/s]
  double wanted_rate = 0.;               ///< as given; `rate` where the pressure is [m^3/s]
  double borehole_pressure = 0.;         ///< NaN: in rock, without a radius of the borehole [Pa]
  double inlet_pressure = 0.;            ///< in fracture or pores at the first perforation [Pa]
  double inlet_aperture = 0.;            ///< there [m]; NaN: in rock
  std::vector<double> perforation_rates; ///< into fracture or rock [m^3/s]

  /// The first perforation opens into it; nothing: into the rock.
  std::optional<unsigned int> inlet_segment;

  /// Of a well in the rock: the least compressive stress in situ, beyond which a pressure fractures
  /// it; zero or less: none is known [Pa].
  double least_stress = 0.;

  /// Of a well in the rock: a fracture has come so near that the pressure in its borehole is not
  /// known any more.
  bool is_reached = false;
};

/// Wells that inject into fractures or the rock, or produce from them, through perforations at
/// points. All perforations of a well share the pressure p_b of its borehole and are throttled one
/// by one:
///
///   p_b - p_i = r q_i + kappa q_i |q_i|,     V c_f dp_b/dt + sum_i q_i = Q   or   p_b given,
///
/// with p_i the pressure in the fracture and r = 0, or the mean pore pressure over a small source
/// and r the resistance of the rock within it (PointSource).
///
/// The rates q_i, and p_b where it is not given, are unknowns, solved with everything else: equal
/// pressure without friction is an unstable split, and no splitting of the equations survives it.
/// A well of given rate with one perforation and no storage needs no unknown.
///
/// A well cannot take what is not there. Where its rate may be negative, its pressure is at least
/// p_min, and the rate becomes what flows at that pressure:
///
///   p_b >= p_min,  V c_f dp_b/dt + sum_i q_i >= Q,  one of the two is an equality.
///
/// The unknown of a rate is y = q/c, and its equation is multiplied by c, with c the well's
/// conductance at the scene's pressure, or 1/r: like all others of the flow it then is a pressure,
/// and its equation a volume, and one tolerance fits all.
template <int dim>
class Wells
{
public:
  /// Subsection "Wells".
  static void declare_parameters(dealii::ParameterHandler &prm);

  /// @param vapour_pressure of the fluid, -infinity where the deck gives none [Pa]
  /// @throws InputError
  void parse_parameters(dealii::ParameterHandler &prm, double vapour_pressure);

  void set_compressibility(const double fluid_compressibility)
  {
    compressibility = fluid_compressibility;
  }

  /// @param pressure of a fracture of this scene [Pa]
  /// @param typical_rate what it takes at this pressure, where no rate is given [m^3/s]
  void set_scales(double pressure, double typical_rate);

  /// The greatest rate that is given, of a whole well into a fracture.
  double maximum_rate() const;

  /// The greatest magnitude of a pressure that is given to a well into a fracture, if one is.
  std::optional<double> maximum_pressure() const;

  bool empty() const
  {
    return wells.empty();
  }

  unsigned int size() const
  {
    return wells.size();
  }

  /// The mesh is new, and with it the cells that perforations in the rock open into. Collective.
  /// @throws EntryError naming a point that the rock there does not suit
  void set_mesh(const MeshView<dim> &mesh, const Scene<dim> &scene, const Collectives &);

  /// Find the segments that the perforations open into.
  /// @throws EntryError naming a point that lies on no segment, or in the rock beside one
  void locate(const std::vector<NetworkSegment<dim>> &segments, bool pressure_is_given);

  /// Whether an extra unknown belongs to a well in the rock.
  bool is_of_rock(unsigned int index) const;

  /// Whether a perforation opens into a segment.
  bool feeds(unsigned int segment) const;

  /// The same from the cracks of the deck, before there is a mesh: a perforation lies on one crack,
  /// to a fiftieth of its length, and no two are at one place.
  /// @throws EntryError naming the point
  void check(const std::vector<InitialCrack<dim>> &cracks) const;

  /// What the wells are to do is finite from the start of the run to its end, and a single well
  /// does not only take fluid from cracks that hold none.
  /// @param rock_gives the pores have fluid for the cracks
  /// @throws EntryError
  void check(double start_time, double end_time, bool rock_gives) const;

  /// Whether a well opens into the rock.
  bool any_in_rock() const
  {
    return std::any_of(wells.begin(), wells.end(), [](const Well &well) { return well.in_rock; });
  }

  /// Whether the source of a well in the rock reaches a piece of this size about a place.
  bool sources_reach(const dealii::Point<dim> &place, double size) const;

  std::vector<ExtraUnknown> unknowns() const;

  /// Index of the first of unknowns().
  void set_offset(unsigned int first_index);

  /// The pressures in fracture or pores that the perforations open into, well by well [Pa].
  /// Collective where a well opens into the rock.
  /// @param segment_pressures by the same unknowns
  std::vector<double> outside_pressures(const std::vector<double> &segment_pressures,
                                        const Unknowns &unknowns,
                                        const Collectives &) const;

  /// The rows of the wells, and their rates in the mass rows of segments and pores: on the first
  /// rank all but what other ranks' cells have.
  /// @param outside see outside_pressures()
  /// @param rows index of the segments' pressure unknowns
  void assemble(const StepContext &context,
                const State &state,
                const std::vector<double> &outside,
                const std::vector<unsigned int> &rows,
                bool is_first_rank,
                Sink &sink) const;

  /// Sum of the magnitudes of the terms in the rows of wells in the rock [m^3].
  double magnitude_of_terms(const StepContext &context,
                            const State &state,
                            const std::vector<double> &outside) const;

  /// Injected, produced, and gained by the boreholes in the step.
  FluidVolumes volumes(const StepContext &context, const State &state) const;

  /// @param apertures of the segments
  /// @param outside see outside_pressures()
  std::vector<WellReport> report(const StepContext &context,
                                 const State &state,
                                 const std::vector<double> &apertures,
                                 const std::vector<double> &outside) const;

  /// The next time after t at which a rate or pressure jumps.
  double next_jump(double t) const;

  /// Whether a borehole stores fluid.
  bool have_volume() const;

  /// Whether all rates and pressures are constant between jumps.
  bool are_in_pieces() const;

  /// Whether a well that has rested until this time begins to inject at a given rate.
  bool starts_at(double t) const;

  /// Names of the wells whose pressure is bounded below, and the bounds [Pa].
  std::vector<std::pair<std::string, double>> minimum_pressures() const;

  /// Rate of the first well into a fracture as the deck gives it, for the whole fracture; zero
  /// where there is none or its pressure is given.
  double first_rate(double t) const;

  /// "Fraction in model" of that well, and where it opens into fractures.
  double first_fraction() const;
  std::vector<dealii::Point<dim>> first_perforations() const;

  /// A well in the rock whose rate is given, as the deck gives it.
  struct SourceInRock
  {
    unsigned int number; ///< among the wells, from 1
    std::vector<dealii::Point<dim>> points;
    double fraction;         ///< in the model
    double borehole_radius;  ///< 0: not given [m]
    TimeHistory rate;        ///< of the whole well [m^3/s]
    double minimum_pressure; ///< in the borehole; -infinity: no bound [Pa]
  };
  std::vector<SourceInRock> sources_in_rock() const;

  /// How a perforation in the rock is represented.
  struct SourceSize
  {
    std::string well; ///< its name
    double radius;    ///< of the source [m]
    bool has_borehole;
  };
  std::vector<SourceSize> sources() const;

  /// What the mesh at the start has decided.
  void save(boost::archive::binary_oarchive &) const;

  void load(boost::archive::binary_iarchive &);

private:
  /// A perforation opens into the nearest segment, into several in equal parts where they are
  /// equally near, as on a symmetry point between two of them; or into the rock.
  struct Perforation
  {
    dealii::Point<dim> point;
    std::vector<unsigned int> segments;
    std::optional<PointSource<dim>> source;
  };

  struct Well
  {
    std::string name;
    unsigned int number = 0; ///< of its subsection
    std::string points;      ///< the perforations as the deck gives them
    bool in_rock = false;    ///< not into fractures
    bool is_reached = false; ///< in rock: by a fracture
    bool pressure_control = false;
    TimeHistory value; ///< Q of the whole well, or p_b
    double fraction = 1.;
    double friction = 0.; ///< kappa, for the rate in the model
    double volume = 0.;   ///< of the borehole, the part in the model
    /// In the borehole; -infinity: no bound [Pa]
    double minimum_pressure = -std::numeric_limits<double>::infinity();
    bool has_own_minimum = false; ///< the deck gives it
    std::vector<Perforation> perforations;
    double conductance = 1.; ///< c [m^3/(Pa s)]
    double initial_pressure = 0.;
    double least_stress = 0.;     ///< as in WellReport
    unsigned int first_index = 0; ///< of y_0, y_1, ..., and then p_b

    bool is_bounded() const
    {
      return std::isfinite(minimum_pressure);
    }

    /// The given rate enters the segment's balance as a number.
    bool is_direct() const
    {
      return !pressure_control && perforations.size() == 1 && volume == 0. && !is_bounded();
    }

    unsigned int n_unknowns() const
    {
      return is_direct() ? 0 : perforations.size() + !pressure_control;
    }

    unsigned int pressure_index() const
    {
      return first_index + perforations.size();
    }

    /// r of a perforation, for the rate in the model [Pa s/m^3].
    double resistance(const unsigned int k) const
    {
      return perforations[k].source ? perforations[k].source->resistance() : 0.;
    }

    /// Given rate into the model, or given pressure.
    double given(const StepContext &context) const
    {
      const double begin = context.time - context.dt, end = context.time;
      return pressure_control ? value(begin, end)
                              : fraction * context.share_of_rates * value.mean(begin, end);
    }

    double
    perforation_rate(const unsigned int k, const StepContext &context, const State &state) const
    {
      return is_direct() ? given(context) : conductance * state.current.extra[first_index + k];
    }

    double rate(const StepContext &context, const State &state, double compressibility) const;

    /// What flows through the perforations and stays in the borehole [m^3/s].
    double flow(const StepContext &context, const State &state, double compressibility) const;

    /// At the least pressure, less than the given rate can be taken: of both conditions the one
    /// that is nearer to being violated holds (an active set; Hintermueller, Ito and Kunisch 2003).
    bool is_dry(const StepContext &context, const State &state, double compressibility) const
    {
      return is_bounded() &&
             flow(context, state, compressibility) - given(context) >
               conductance * (state.current.extra[pressure_index()] - minimum_pressure);
    }
  };

  /// The well of a subsection that has been entered.
  static Well read_well(dealii::ParameterHandler &prm, unsigned int number, double vapour_pressure);

  /// What is wrong with the place of a perforation.
  static EntryError
  perforation_error(const Well &well, const Perforation &perforation, const std::string &what);

  static double mean(const Perforation &perforation, const std::vector<double> &values);

  /// Of a well in the rock, what its section says of the borehole and the source.
  static void read_source(dealii::ParameterHandler &prm, const std::string &path, Well &well);

  /// The row of a perforation and its rate in the rows of what it opens into.
  void assemble_perforation(const Well &well,
                            unsigned int k,
                            const StepContext &context,
                            const State &state,
                            double outside,
                            const std::vector<unsigned int> &rows,
                            bool is_first_rank,
                            LocalSystem &local) const;

  /// The row of a borehole.
  void assemble_borehole(const Well &well,
                         const StepContext &context,
                         const State &state,
                         LocalSystem &local) const;

  /// The sources of perforations in the rock do not overlap, where boreholes' pressures follow.
  /// @throws EntryError naming a point
  void check_distances() const;
  void check_openings() const;

  /// Where segments must not be.
  void locate_in_rock(Well &well, const std::vector<NetworkSegment<dim>> &segments) const;

  /// The first well into a fracture; null: there is none.
  const Well *first_into_fracture() const;

  std::vector<Well> wells;
  double compressibility = 0.;
  bool has_started = false; ///< fractures have been found once
};
} // namespace stockwork
