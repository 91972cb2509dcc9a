#pragma once

#include "discontinuity/contact.h"
#include "discontinuity/discontinuity.h"
#include "discontinuity/stress_ahead.h"
#include "fracture/cohesive_xfem/growth_limits.h"
#include "fracture/cohesive_xfem/law.h"
#include "fracture/cohesive_xfem/parameters.h"
#include "stockwork/fracture/model.h"

#include <array>
#include <unordered_map>
#include <unordered_set>

namespace stockwork::cohesive_xfem
{
/// Cracks that cut through cells, held together by cohesive tractions; a tip advances by whole
/// cells where the averaged total stress ahead of it plus its fluid pressure exceeds the tensile
/// strength. After Wang (2016), with the criterion corrected; see README.md.
template <int dim>
class CohesiveXFEM : public FractureModel<dim>
{
public:
  using typename FractureModel<dim>::CellIterator;

  CohesiveXFEM(const Parameters &parameters, const Scene<dim> &scene);

  Requirements requirements() const override
  {
    Requirements needs;
    needs.symmetric = !contact.has_friction();
    needs.regional_rock = RegionalRock::of_uniform_strength;
    needs.random_rock = true;
    needs.may_grow = parameters.growth;
    return needs;
  }

  bool uses_secants() const override
  {
    return contact.uses_secants();
  }

  void setup(const MeshView<dim> &mesh_view, const Collectives &collectives) override;

  void begin_step(const StepContext &context) override;

  std::vector<ExtraUnknown> extra_unknowns() const override;

  dealii::ArrayView<const Segment<dim>> segments() const override;

  CellRole<dim> role(const CellIterator &cell) const override;

  void assemble(const StepContext &context, const State &state, Sink &sink) const override;

  Verdict
  advance(const StepContext &context, const State &state, const Collectives &collectives) override;

  bool commit(const StepContext &context, const State &state) override;

  void rollback() override;

  void wanted_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                        std::vector<float> &sizes) const override;

  double tensile_strength() const override
  {
    return law.strength;
  }

  std::vector<std::string> take_messages() override;

  void save(boost::archive::binary_oarchive &archive) const override;

  void load(boost::archive::binary_iarchive &archive) override;

  FractureSummary summary(const State &state, const Collectives &collectives) const override;

  void write_fields(const State &state, FieldSink<dim> &sink) const override;

private:
  static constexpr unsigned int n_points = JumpShapes<dim>::n_points;
  using PointDamage = std::array<double, n_points>;

  void start(const Collectives &collectives);

  /// Refuse a crack too short for the cells, and say where one is not as long as it is given.
  void check_lengths();

  /// Of the crack with the shortest way from its middle, or its mouth, to a tip that may grow;
  /// infinite without such a tip [m].
  double shortest_half_length() const;

  /// The tensile strength, chosen for cells of this size if it is not given [Pa]; says what is
  /// coarse.
  double strength_of_cells(double size);

  void refresh_segments();

  /// Committed damage of a piece; zero for a new one.
  PointDamage damage(const CrackPiece<dim> &piece) const;

  /// Share of a piece that has no strength left and rubs where its faces touch, of the last step.
  double broken_share(const CrackPiece<dim> &piece) const;

  /// Separation of the faces in the frame of the piece.
  NormalShear separation(const CrackPiece<dim> &piece,
                         const JumpShapes<dim> &shapes,
                         const unsigned int point,
                         const std::vector<JumpColumn> &columns,
                         const std::vector<double> &a) const;

  /// What a part of a crack holds [m^2].
  double volume(unsigned int crack, const CrackSpan &pieces, const Unknowns &) const;

  /// In-situ compression across a piece [Pa].
  double closing_stress(const CrackPiece<dim> &piece) const;

  /// Distance along the crack from this end to where the damage is at least so much [m].
  double distance_to_damage(unsigned int crack, CrackEnd end, double least, const State &) const;

  /// Whether pressure or suction at this end of a crack, beyond the stress that closes it, is so
  /// much greater than the strength that the latter does not matter.
  bool fluid_overpowers(unsigned int crack, CrackEnd end, const State &) const;

  /// How far into the last span at this end of a crack the fluid has come [m]: all of it, unless
  /// there is suction in it, as in viscous fluid, and the tip is bare. Then from its volume and
  /// that of the span before, with the opening x^(2/3) of such a tip (Desroches et al. 1994).
  double reached_length(unsigned int crack, CrackEnd end, const State &) const;

  /// Whether faces overlap too much, which then carry more: the step is to be solved again.
  bool press_faces(const State &);

  /// Why the run has to end although the step has converged: every crack that has grown is blocked
  /// and takes more fluid all the same. Empty if it need not.
  std::string reason_to_stop(const State &) const;

  /// Warn, once, of a tip that is arrested although the rock ahead of it should have parted.
  /// @param drive tension ahead plus pressure [Pa]
  void
  warn_of_arrested_tip(unsigned int crack, CrackEnd end, double drive, const std::string &cause);

  using Advance = typename Discontinuity<dim>::Advance;

  /// A tip that may grow, and what the rock ahead of it bears.
  struct TipAhead
  {
    Advance advance;     ///< straight on
    RockAhead<dim> near; ///< for whether it grows
    RockAhead<dim> wide; ///< for its direction
  };
  std::vector<TipAhead> look_ahead(const State &state, const Collectives &collectives) const;

  /// What the rock bears around these tips and ahead of them.
  std::vector<TipAhead> look_ahead(const std::vector<HalfDisc<dim>> &tips,
                                   const std::vector<Advance> &advances,
                                   const State &state,
                                   const Collectives &collectives) const;

  /// Begin a crack where another has joined a third one, on the other side of that, if tension and
  /// fluid pressure there reach the strength. Returns whether one has begun.
  bool cross(const State &state, const Collectives &collectives);

  /// One look at all tips: those that grow, whether the rock is broken behind each, and what comes
  /// of it.
  struct GrowthPass
  {
    std::vector<Advance> growing;
    std::vector<bool> broken;
    bool held_back = false; ///< a tip wants to advance by more spans than it may in a step
    bool grown = false, needs_mesh = false;
  };

  enum class TipState
  {
    rests,   ///< for now, or grows
    arrested ///< by the mesh, and driven hopelessly hard
  };
  TipState judge(const TipAhead &tip, const State &state, GrowthPass &pass);

  dealii::Tensor<1, dim> direction_of_growth(const TipAhead &tip) const;

  /// The greatest tension ahead, or with straight growth that across the crack [Pa].
  double tension_across(const TipAhead &tip) const;

  /// Cut the cells ahead. Returns why the run has to end; empty: it need not.
  std::string grow(GrowthPass &pass, const Collectives &collectives);

  /// Note what a tip has grown by. Returns as grow().
  std::string take_new_span(const GrowthPass &pass, unsigned int tip);

  /// The law of rock at a place. The strength is that of the whole rock times the factor of the
  /// place.
  CohesiveLaw law_at(dealii::types::material_id region, const dealii::Point<dim> &place) const;

  /// The law of a piece: where it is of cement, that takes its share of the rock's energy.
  CohesiveLaw law_at(const CrackPiece<dim> &piece) const;

  /// The strength of the rock half a cell ahead of an end of a crack [Pa].
  double strength_ahead(unsigned int crack, CrackEnd end) const;

  /// E' G_c / T^2 in the rock of a region [m].
  double cohesive_length(dealii::types::material_id region) const;

  Parameters parameters;
  const Scene<dim> &scene;
  CohesiveLaw law; ///< where nothing varies; see law_at()
  Discontinuity<dim> discontinuity;
  FaceContact<dim> contact;
  std::unique_ptr<MeshView<dim>> mesh_view;
  std::vector<Segment<dim>> all_segments;
  std::vector<std::string> messages;

  // History, the same on all ranks, by key of the piece, or of the span.
  std::unordered_map<std::uint64_t, PointDamage> committed_damage;
  std::unordered_map<std::uint64_t, double> committed_reach; ///< of spans at ends [m]
  /// Spans at ends to which the rock is broken, without a cohesive zone that spans cells: the
  /// fluid alone makes the shape of such a tip.
  std::unordered_set<std::uint64_t> committed_bare_tips;
  std::vector<CrackPath<dim>> committed_paths;
  GrowthLimits committed_limits;
  std::unordered_set<std::uint64_t> cemented; ///< cohesive cracks of the deck, if weaker than rock
  double dissipated = 0.;                     ///< [J/m]
  double largest_cell = 0.;                   ///< of those along the initial cracks [m]
  bool started = false;                       ///< a step has been accepted

  // Of the current step.
  unsigned int n_presses = 0;                        ///< solves for faces that overlapped
  std::size_t n_messages_before = 0;                 ///< messages that a rollback leaves
  std::vector<std::array<unsigned int, 2>> advances; ///< spans, by crack and end
  std::unordered_set<std::uint64_t> bare_tips;
  GrowthLimits limits;
};
} // namespace stockwork::cohesive_xfem
