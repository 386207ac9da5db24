#include "viewer/app/scene_opener.h"

#include <chrono>
#include <utility>

#include <GLFW/glfw3.h>

namespace fluxwalk::app {

SceneOpener::SceneOpener(GLFWwindow* window, OpenScene open) : window_(window), open_(std::move(open)) {
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* dropped, int count, const char** files) {
        if (count > 0) {
            static_cast<SceneOpener*>(glfwGetWindowUserPointer(dropped))->open(files[0]);
        }
    });
}

SceneOpener::~SceneOpener() {
    glfwSetDropCallback(window_, nullptr);
    glfwSetWindowUserPointer(window_, nullptr);
}

void SceneOpener::open(const std::string& scene) {
    if (result_.valid()) {
        waiting_ = scene;
    } else {
        start(scene);
    }
}

void SceneOpener::start(const std::string& scene) {
    opening_ = scene;
    result_ = std::async(std::launch::async, [open = open_, scene] {
        auto exhibit = open(scene);
        glfwPostEmptyEvent();
        return exhibit;
    });
}

std::unique_ptr<Exhibit> SceneOpener::takeReady() {
    if (!result_.valid() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        return nullptr;
    }
    std::unique_ptr<Exhibit> ready;
    try {
        ready = result_.get();
    } catch (const std::exception& error) {
        error_ = error.what();
    }
    opening_.clear();
    if (waiting_) {
        ready.reset();
        error_.reset();
        start(*std::exchange(waiting_, std::nullopt));
    }
    return ready;
}

}  // namespace fluxwalk::app
