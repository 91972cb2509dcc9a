#pragma once

#include "fracture/peridynamics/crossed_cells.h"
#include "stockwork/exchange/scene.h"

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace stockwork::peridynamics
{
/// The direction at right angles to the greatest principal stress, nearest to another one.
dealii::Tensor<1, 2> across_greatest(const dealii::SymmetricTensor<2, 2> &stress,
                                     const dealii::Tensor<1, 2> &ahead);

/// The ways of cracks in a plane, as lines of straight pieces about as long as cells: an initial
/// crack, and ahead of each of its ends that is in rock the way that it will take. Bonds soften
/// only where they cross one. How far a tip has come on its way is known from the energy that has
/// been dissipated across it. Pieces that fluid has reached are segments, in the order of the
/// paths: those that a tip has come to; in elastic rock the next one, too, as soon as most of it
/// lies in the process zone, or a little before the tip comes to it; in porous rock all of the
/// process zone. Of a path that begins beyond another one, or where there is none, the first when
/// it has taken a tenth of its energy; beyond cement, the less of that, the more the cement takes.
class TrackedPaths
{
public:
  struct Crossing
  {
    unsigned int path;
    double arc; ///< from the first point of the initial crack, negative before it [m]
  };

  /// A place on a path.
  using Joint = Crossing;

  struct Piece
  {
    unsigned int path;
    dealii::Point<2> from, to;
    double begin, end; ///< arc [m]
    bool at_tip;       ///< the fluid ends here, within rock
    std::vector<unsigned int> neighbours;
    double weight = 1.; ///< in the shares of bonds
    /// Of a piece that fluid has reached within the step, the last one that it had reached before,
    /// which until then the bonds here belonged to.
    std::optional<unsigned int> part_of = std::nullopt;
  };

  /// An end that grows, by its path and its side (0: before the first point, 1: after the last).
  struct End
  {
    unsigned int path, side;
  };

  /// @param spacing length of pieces [m]
  /// @param may_grow from a point that is the end of a crack
  /// @param cement of cohesive cracks, see Path
  void reinit(const std::vector<InitialCrack<2>> &cracks,
              double spacing,
              const std::function<bool(const dealii::Point<2> &)> &may_grow,
              double cement = 1.);

  /// Of the line from a to b, nearest to its middle; of two paths of which one is cemented, that
  /// which it crosses more squarely. Nothing if it crosses no path.
  std::optional<Crossing> crossing(const dealii::Point<2> &a, const dealii::Point<2> &b) const;

  /// Whether the line from a to b crosses an initial crack, not its ways.
  bool
  crosses_initial(unsigned int path, const dealii::Point<2> &a, const dealii::Point<2> &b) const;

  dealii::Point<2> point(const Crossing &crossing) const;

  /// Unit normal of the piece that is crossed there, to its left.
  dealii::Tensor<1, 2> left(const Crossing &crossing) const;

  /// Whether all lines are those of the other paths.
  bool run_as(const TrackedPaths &other) const;

  /// Corners of the boxes that hold pieces, of ways as well.
  std::vector<std::array<dealii::Point<2>, 2>> boxes() const;

  /// The wet pieces that a bond belongs to which crosses a path there. So many bonds do, per length
  /// of the path, in the mean over some cells only; so a bond is shared out to all of a length of
  /// two pieces around. None if the fluid is farther than @p reach [m].
  CellShares shares(const Crossing &crossing, double reach) const;

  /// Bonds that cross a path there, and what they read of an opening that is the same everywhere.
  using Readings = std::vector<std::pair<Crossing, double>>;

  /// From now on share bonds out so that all wet pieces read such an opening alike. A path that is
  /// oblique to the lattice is crossed by up to 5 per cent more bonds here than there, in the mean
  /// over two pieces. Of paths that are nearer to another one shares stay as they are.
  /// @param apart farther than bonds and ways reach [m]
  void share_evenly(const std::function<Readings()> &read, double apart);

  /// The end whose way is crossed there; nothing on an initial crack.
  std::optional<End> end_at(const Crossing &crossing) const;

  const std::vector<Piece> &wet_pieces() const
  {
    return wet;
  }

  /// All that grow.
  std::vector<End> ends() const;

  /// Of an end that grows, how far its tip has come [m].
  double advance(const End &end) const
  {
    return at(end).advance;
  }

  /// How far the tip of an end has come, on the way that is there [m], and fluid where it is ahead
  /// of that.
  /// @param same_bonds no bond is about to soften that has not been known to
  /// @return whether fluid has reached other pieces than before
  bool set_advances(const std::function<double(const End &)> &advance,
                    const std::function<double(const End &)> &fluid,
                    bool same_bonds = false);

  /// A step is accepted: fluid stays where it is.
  void keep_fluid()
  {
    for (Path &path : paths)
      for (Growth &growth : path.ends)
        growth.kept = growth.wet;
    went_on_from.clear();
  }

  /// Fluid leaves pieces that it has reached in this step, and that its front, by the tips as they
  /// are, is not in. But where it went on by itself from what would be left, it would come again.
  /// @return whether there are any
  bool let_fluid_back();

  /// How far along the way of an end that is crossed there [m].
  double along_way(const Crossing &crossing, const End &end) const;

  /// Length of the way of an end [m].
  double way(const End &end) const;

  /// What is left of the way ahead of the tip [m].
  double lead(const End &end) const;

  /// Where the tip is.
  dealii::Point<2> tip(const End &end) const;

  /// Of the last piece of the way, outwards.
  dealii::Tensor<1, 2> direction(const End &end) const;

  bool has_set_out(const End &end) const
  {
    return at(end).n_points > 0;
  }

  /// A piece more of each of these ends, in its direction. It ends at another path if it meets one,
  /// or comes as near as half of a piece; then the end does not grow any more. So it does if it
  /// comes past another path as near as one and a half: bonds tell no two lines there. Two ends
  /// that come upon one another meet half-way. All pieces follow from the paths as they are,
  /// whatever the order of the ends; one that would join what another has joined just now gets none
  /// yet.
  void extend(const std::vector<std::pair<End, dealii::Tensor<1, 2>>> &ahead);

  /// Forget the way ahead, where nothing has softened yet.
  void forget_way(const End &end);

  /// Where the way of an end has met another path, and may go on beyond it. Not where it came past.
  struct Meeting
  {
    End end;                     ///< that has met the path
    dealii::Point<2> place;      ///< on that
    dealii::Tensor<1, 2> across; ///< unit normal of that, to the far side
    std::optional<End> beyond;   ///< of the path there, if there is one
  };

  std::vector<Meeting> meetings() const;

  /// Whether the way of an end has met another path.
  bool has_met(const End &end) const
  {
    return at(end).joined && at(end).n_points > 0;
  }

  /// Beyond a path that has been met, another one begins, with a piece in this direction. If one
  /// has begun there before it is forgotten.
  void begin_beyond(const Meeting &meeting, const dealii::Tensor<1, 2> &direction);

  /// Whether no part of a path is an initial crack.
  bool is_all_way(const unsigned int path) const
  {
    return paths[path].ends[0].n_points + paths[path].ends[1].n_points == paths[path].n_pieces();
  }

  /// Whether a path has begun beyond another one.
  bool began_beyond(const unsigned int path) const
  {
    return is_all_way(path) && paths[path].ends[0].joined && paths[path].ends[0].n_points == 0;
  }

  /// A path with a piece to either side of a place.
  /// @param dry fluid gets in only where a path that has some joins it
  void begin_at(const dealii::Point<2> &place, const dealii::Tensor<1, 2> &direction, bool dry);

  /// A path with a piece that leads away from a place on the boundary of the domain, where its
  /// other end does not grow.
  void
  begin_at_side(const dealii::Point<2> &place, const dealii::Tensor<1, 2> &direction, bool dry);

  unsigned int n_paths() const
  {
    return paths.size();
  }

  /// Whether another path has joined the way of an end.
  bool is_joined(const End &end) const;

  /// Whether fluid has reached any piece of a path.
  bool is_wet(unsigned int path) const;

  /// The place nearest to a point on any path, ways as well, but one of them; and how far it is
  /// [m].
  std::pair<Joint, double> nearest(const dealii::Point<2> &point, unsigned int but) const;

  /// A place where two pieces would be one segment: they lie upon one another, or cross in the
  /// middle of both.
  std::optional<dealii::Point<2>> overlap() const;

  /// Where two of them cross, of which neither ends there, or one crosses itself: fluid would not
  /// pass over.
  std::optional<dealii::Point<2>> cross() const;

  /// Of a point from the nearest piece of any path or way [m].
  double distance(const dealii::Point<2> &point) const;

  /// Length of the initial cracks and of what tips have advanced by [m].
  double length() const;

  /// Of what the deck gives [m].
  double initial_length() const;

  /// Of one path, its initial crack and what its tips have advanced by, and as much again where an
  /// end is at a side of the domain; infinite where it has joined another one [m].
  double full_length(unsigned int path) const;

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &h &paths;
    if (Archive::is_loading::value)
      find_wet_pieces();
  }

private:
  /// Places that are nearer to one another are the same [pieces].
  static constexpr double same_spot = 1e-6;

  /// Shorter pieces are joined with the one before [pieces].
  static constexpr double short_piece = 0.45;

  /// Where the line from a to b crosses the one from c to d, as shares of their lengths. A point on
  /// the second line belongs to its left side.
  static std::optional<std::array<double, 2>> meet(const dealii::Point<2> &a,
                                                   const dealii::Point<2> &b,
                                                   const dealii::Point<2> &c,
                                                   const dealii::Point<2> &d,
                                                   double tolerance);

  struct Growth
  {
    bool grows = false;
    unsigned int n_points = 0;     ///< of its way
    double advance = 0., wet = 0.; ///< of the tip, and the farthest of the fluid so far [m]
    double kept = 0.;              ///< of the fluid at the last step [m]
    double front = 0.;             ///< of the fluid by the tip as it is; not kept [m]
    bool joined = false;           ///< it has met another path
    bool passes = false;           ///< and came past it
    unsigned int joined_path = 0;  ///< which
    double joined_arc = 0.;        ///< and where on it
    unsigned int beyond = 0;       ///< path that begins there on the far side, 0: none

    template <class Archive>
    void serialize(Archive &ar, const unsigned int)
    {
      ar &grows &n_points &advance &wet &kept &joined &passes &joined_path &joined_arc &beyond;
    }
  };

  struct Path
  {
    std::vector<std::array<double, 2>> points; ///< of the ways as well
    std::array<Growth, 2> ends;
    bool dry = false; ///< as long as no path with fluid has joined it
    /// Of an initial crack across which bonds hold, their energy over that in rock; 0: all others.
    double cement = 0.;

    template <class Archive>
    void serialize(Archive &ar, const unsigned int)
    {
      ar &points &ends &dry &cement;
      if (Archive::is_loading::value)
        find_arcs();
    }

    unsigned int n_pieces() const
    {
      return points.size() - 1;
    }

    dealii::Point<2> point(const unsigned int i) const
    {
      return dealii::Point<2>(points[i][0], points[i][1]);
    }

    double length(const unsigned int piece) const
    {
      return point(piece).distance(point(piece + 1));
    }

    /// Arc at which a piece begins; that of the last point, for one beyond the last [m].
    double begin(const unsigned int piece) const
    {
      AssertDimension(arcs.size(), points.size());
      return arcs[piece];
    }

    /// To be called when points have changed, and how many of them are ahead of the first end.
    void find_arcs();

  private:
    std::vector<double> arcs; ///< of the points
  };

  /// Of one path [m].
  static double initial_length(const Path &path);

  /// Whether the initial crack of a path runs along an axis, from its first to its last point.
  bool begins_along_lattice(const Path &path) const;

  /// Whether all others are farther away.
  bool is_apart(unsigned int path, double distance) const;

  /// Number of the piece that is crossed there.
  unsigned int piece_at(const Crossing &crossing) const;

  const Growth &at(const End &end) const
  {
    return paths[end.path].ends[end.side];
  }

  /// Where the next piece of an end leads, and what it joins.
  struct Extension
  {
    dealii::Point<2> next;
    bool joins = false, passes = false; ///< see Growth
    Joint joint{};
    std::optional<End> towards{}; ///< the tip whose way it is led to
    bool meets = false;           ///< that one half-way
  };

  Extension extension(const End &end, const dealii::Tensor<1, 2> &direction) const;

  /// Whether the line ahead meets a path, so that there is no need to turn to it.
  bool leads_to(const dealii::Point<2> &head,
                const dealii::Tensor<1, 2> &direction,
                unsigned int path) const;

  /// The end that grows and has come so far on a path.
  std::optional<End> head_at(const Joint &joint) const;

  /// The same, or the end that grows and whose way is there.
  std::optional<End> tip_of(const Joint &joint) const;

  /// The last point of the way of an end.
  dealii::Point<2> head(const End &end) const
  {
    const Path &path = paths[end.path];
    return path.point(end.side == 0 ? 0 : path.n_pieces());
  }

  /// A piece more, or where it is short the last one up to there; nothing if there is none.
  /// @return whether the end is there
  bool lead_to(const End &end, const dealii::Point<2> &place);

  /// Where an initial crack has joined an end, that goes no further.
  bool stops_where_joined(const End &end);

  void join_heads(const End &a, const End &b);

  /// Where an initial crack ends at another one.
  void join_where_it_begins(const End &end);

  /// Pieces of the ways of a path that its tips, and fluid if there is any, have reached.
  /// @param fluid how far it is, now or at the last step
  std::array<unsigned int, 2> reached(unsigned int path, const double Growth::*fluid) const;

  /// Fluid gets into dry paths where those that have some meet them.
  void wet_what_is_joined();

  void find_wet_pieces();

  /// Find them again. If all are the same they keep their weights. @return whether there are others
  bool wets_others();

  static bool are_same(const std::vector<Piece> &some, const std::vector<Piece> &others);

  double h = 0.;
  std::vector<Path> paths;
  std::vector<Piece> wet;
  std::vector<Piece> went_on_from; ///< wet before fluid went on without any bond; empty: it did not
};
} // namespace stockwork::peridynamics
