#pragma once

namespace fluxwalk::app {

/// How many samples a pixel the window's pictures get: as many as leave movement fluid, all where it stands
/// still.
class SampleChoice {
  public:
    /// `most` samples. Software begins with one while moving, since it will not do more.
    SampleChoice(int most, bool isSoftware) : most_(most), whileMoving_(isSoftware ? 1 : most) {}

    /// Tells how long a picture with so many samples took while moving: seconds.
    void report(int samples, double seconds);
    int choose(bool isMoving) const { return isMoving ? whileMoving_ : most_; }

  private:
    int most_;
    int whileMoving_;
    int slow_ = 0;
    int fast_ = 0;
};

}  // namespace fluxwalk::app
