#include "configuration_space/moving_frame.h"

#include "numerics/trigonometry.h"

namespace starcell {
namespace {

Interval wide(double reach) { return {-reach, reach}; }

class FreeFrame final : public MovingFrame {
 public:
  explicit FreeFrame(double unit) : per_unit_(1 / unit) {}

  FrameFunctions expand(const Interval3& center, const Vec3& reach) const override {
    FrameFunctions f;
    const Interval k(per_unit_), angle = center.z * k;
    f.angle = (center.z + wide(reach.z())) * k;
    const Turn at = turn_by(angle), over = turn_by(f.angle);
    const Interval x = center.x + wide(reach.x()), y = center.y + wide(reach.y()), none(0.0), one(1.0), kk = k * k;
    f.of[FrameFunctions::x] = {center.x, {one, none, none}, {one, none, none}, {}};
    f.of[FrameFunctions::y] = {center.y, {none, one, none}, {none, one, none}, {}};
    f.of[FrameFunctions::cosine] = {at.cosine, {none, none, -k * at.sine}, {none, none, -k * over.sine}, {none, none, -kk * over.cosine, none, none, none}};
    f.of[FrameFunctions::sine] = {at.sine, {none, none, k * at.cosine}, {none, none, k * over.cosine}, {none, none, -kk * over.sine, none, none, none}};
    // R^T t = (x cos + y sin, -x sin + y cos), and each one's derivative by the angle is the other, or its negative.
    const Interval u = center.x * at.cosine + center.y * at.sine, v = center.y * at.cosine - center.x * at.sine;
    const Interval over_u = x * over.cosine + y * over.sine, over_v = y * over.cosine - x * over.sine;
    f.of[FrameFunctions::seen_x] = {u, {at.cosine, at.sine, k * v}, {over.cosine, over.sine, k * over_v}, {none, none, -kk * over_u, none, -k * over.sine, k * over.cosine}};
    f.of[FrameFunctions::seen_y] = {v, {-at.sine, at.cosine, -k * u}, {-over.sine, over.cosine, -k * over_u}, {none, none, -kk * over_v, none, -k * over.cosine, -k * over.sine}};
    return f;
  }

 private:
  double per_unit_;
};

// Sums of lengths times cosines and sines of sums of angles.
class LinkFrame final : public MovingFrame {
 public:
  LinkFrame(const std::array<double, 3>& lengths, const std::array<double, 2>& base, double unit, int link, int from)
      : lengths_(lengths), base_(base), per_unit_(1 / unit), link_(link), from_(from) {}

  FrameFunctions expand(const Interval3& center, const Vec3& reach) const override {
    FrameFunctions f;
    const Interval none(0.0);
    const FrameFunction nothing{none, {none, none, none}, {none, none, none}, {none, none, none, none, none, none}};
    f.of.fill(nothing);
    using F = FrameFunctions;
    // The joint: link i before it turns by the angles after `from` up to i; seen from the link itself, back by those after i.
    for (int i = std::max(from_, 0); i < link_; ++i) {
      add(f.of[F::x], f.of[F::y], lengths_[static_cast<std::size_t>(i)], center, reach, from_ + 1, i, 1);
      add(f.of[F::seen_x], f.of[F::seen_y], lengths_[static_cast<std::size_t>(i)], center, reach, i + 1, link_, -1);
    }
    add(f.of[F::cosine], f.of[F::sine], 1, center, reach, from_ + 1, link_, 1);
    f.angle = sum(center, from_ + 1, link_) * Interval(per_unit_);
    double far = 0;
    for (int i = from_ + 1; i <= link_; ++i) far += reach[i];
    f.angle = f.angle + wide(far) * Interval(per_unit_);
    if (from_ < 0) {
      f.of[F::x].value += base_[0];
      f.of[F::y].value += base_[1];
      const FrameFunction c = f.of[F::cosine], s = f.of[F::sine];
      accumulate(f.of[F::seen_x], base_[0], c, base_[1], s);
      accumulate(f.of[F::seen_y], base_[1], c, -base_[0], s);
    }
    return f;
  }

 private:
  static Interval sum(const Interval3& q, int first, int last) {
    Interval total(0.0);
    for (int i = first; i <= last; ++i) total += q[i];
    return total;
  }

  // length (cos, sin) of `sense` times the sum of angles first .. last.
  void add(FrameFunction& x, FrameFunction& y, double length, const Interval3& center, const Vec3& reach, int first, int last, double sense) const {
    double far = 0;
    for (int i = first; i <= last; ++i) far += reach[i];
    const Interval k(per_unit_), angle = sum(center, first, last) * k * sense, l(length), g = l * k * sense, h = l * k * k;
    const Turn at = turn_by(angle), over = turn_by(angle + wide(far) * k);
    x.value += l * at.cosine;
    y.value += l * at.sine;
    const auto on = [&](int i) { return i >= first && i <= last; };
    const auto along = [&](Interval3& v, const Interval& by) {
      if (on(0)) v.x += by;
      if (on(1)) v.y += by;
      if (on(2)) v.z += by;
    };
    along(x.gradient, -g * at.sine), along(x.slope, -g * over.sine);
    along(y.gradient, g * at.cosine), along(y.slope, g * over.cosine);
    const auto bend = [&](IntervalSymmetric& m, const Interval& by) {
      if (on(0)) m.xx += by;
      if (on(1)) m.yy += by;
      if (on(2)) m.zz += by;
      if (on(0) && on(1)) m.xy += by;
      if (on(0) && on(2)) m.xz += by;
      if (on(1) && on(2)) m.yz += by;
    };
    bend(x.hessian, -h * over.cosine);
    bend(y.hessian, -h * over.sine);
  }

  static void accumulate(FrameFunction& to, double a, const FrameFunction& f, double b, const FrameFunction& g) {
    const Interval p(a), q(b);
    to.value += p * f.value + q * g.value;
    to.gradient = to.gradient + p * f.gradient + q * g.gradient;
    to.slope = to.slope + p * f.slope + q * g.slope;
    to.hessian = to.hessian + p * f.hessian + q * g.hessian;
  }

  std::array<double, 3> lengths_;
  std::array<double, 2> base_;
  double per_unit_;
  int link_, from_;
};

}  // namespace

MovingFramePtr free_frame(double unit) { return std::make_shared<FreeFrame>(unit); }

MovingFramePtr link_frame(const std::array<double, 3>& lengths, const std::array<double, 2>& base, double unit, int link, int from) {
  return std::make_shared<LinkFrame>(lengths, base, unit, link, from);
}

}  // namespace starcell
