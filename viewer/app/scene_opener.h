#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "viewer/app/exhibit.h"

struct GLFWwindow;

namespace fluxwalk::app {

/// Makes a scene ready to be walked through. Throws what is wrong with it, in one line.
using OpenScene = std::function<std::unique_ptr<Exhibit>(const std::string& scene)>;

/// Opens scenes beside the running window: files that are dropped on it, and others by name. One at a time; a
/// later wish takes the place of one that still waits.
class SceneOpener {
  public:
    /// Takes the window's drop events while it lives.
    SceneOpener(GLFWwindow* window, OpenScene open);
    ~SceneOpener();
    SceneOpener(const SceneOpener&) = delete;
    SceneOpener& operator=(const SceneOpener&) = delete;

    void open(const std::string& scene);
    /// The scene that is being opened; empty for none.
    const std::string& opening() const { return opening_; }

    /// To be called for each frame: a scene that is ready, once.
    std::unique_ptr<Exhibit> takeReady();
    /// What was wrong with the last one, once.
    std::optional<std::string> takeError() { return std::exchange(error_, std::nullopt); }

  private:
    void start(const std::string& scene);

    GLFWwindow* window_;
    OpenScene open_;
    std::string opening_;
    std::optional<std::string> waiting_;
    std::optional<std::string> error_;
    std::future<std::unique_ptr<Exhibit>> result_;
};

}  // namespace fluxwalk::app
