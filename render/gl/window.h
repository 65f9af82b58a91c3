// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight {

/// What the user did since the last `poll`.
struct WindowInput {
    /// Pixels that the mouse was dragged.
    glm::dvec2 drag{0.0};
    /// Steps of its wheel.
    double scroll = 0.0;
    /// Keys that were pressed, as characters in upper case.
    std::string keys;
};

/// A window with an OpenGL 4.5 core context, current on the thread that made it (GLFW: the main
/// one).
class Window {
  public:
    /// Errors: there is no screen, or no such context; GLFW's words.
    [[nodiscard]] static Result<Window> create(uint32_t width, uint32_t height,
                                               const std::string& title);

    /// Pixels, which change when the user resizes it; 0 while it is hidden.
    [[nodiscard]] glm::uvec2 size() const;

    void resize(uint32_t width, uint32_t height);

    /// Takes what the user did; Escape closes.
    [[nodiscard]] WindowInput poll();

    [[nodiscard]] bool is_closed() const;
    void close();

    void set_title(const std::string& title);

    /// Shows what was drawn into framebuffer 0.
    void swap();

  private:
    struct State;

    struct Destroy {
        void operator()(State* state) const;
    };

    explicit Window(std::unique_ptr<State, Destroy> state) : state_(std::move(state)) {}

    std::unique_ptr<State, Destroy> state_;
};

}  // namespace tetralight
