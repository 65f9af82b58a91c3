// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight {

/// Input since the last `poll`.
struct WindowInput {
    /// Mouse drag in pixels.
    glm::dvec2 drag{0.0};
    /// Steps of the mouse wheel.
    double scroll = 0.0;
    /// Pressed keys as upper-case characters.
    std::string keys;
};

/// A window with an OpenGL 4.5 core context, current on the thread that created it. GLFW requires
/// the main thread.
class Window {
  public:
    /// Returns unsupported with GLFW's message if there is no screen or no such context.
    [[nodiscard]] static Result<Window> create(uint32_t width, uint32_t height,
                                               const std::string& title);

    /// Size in pixels; 0 while the window is hidden.
    [[nodiscard]] glm::uvec2 size() const;

    void resize(uint32_t width, uint32_t height);

    /// Returns the input since the last call. Escape closes the window.
    [[nodiscard]] WindowInput poll();

    [[nodiscard]] bool is_closed() const;
    void close();

    void set_title(const std::string& title);

    /// Shows framebuffer 0.
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
