// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/window.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace tetralight {

struct Window::State {
    GLFWwindow* window = nullptr;
    WindowInput input;
    glm::dvec2 mouse{0.0};
};

namespace {

Error glfw_error(const char* what) {
    const char* words = nullptr;
    glfwGetError(&words);
    return {ErrorCode::Unsupported,
            std::string("OpenGL: ") + what + ": " + (words ? words : "no reason given")};
}

WindowInput& input_of(GLFWwindow* window) {
    return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

void take_key(GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_PRESS) return;
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
    if (key >= GLFW_KEY_SPACE && key <= GLFW_KEY_Z) input_of(window).keys += static_cast<char>(key);
}

void take_scroll(GLFWwindow* window, double, double steps) {
    input_of(window).scroll += steps;
}

}  // namespace

void Window::Destroy::operator()(State* state) const {
    glfwDestroyWindow(state->window);
    glfwTerminate();
    delete state;
}

Result<Window> Window::create(uint32_t width, uint32_t height, const std::string& title) {
    if (!glfwInit()) return glfw_error("no screen for a window");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    GLFWwindow* window = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height),
                                          title.c_str(), nullptr, nullptr);
    if (!window) {
        const Error error = glfw_error("no window with OpenGL 4.5");
        glfwTerminate();
        return error;
    }
    std::unique_ptr<State, Destroy> state(new State{window, {}, {}});
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window, &state->input);
    glfwSetKeyCallback(window, take_key);
    glfwSetScrollCallback(window, take_scroll);
    glfwGetCursorPos(window, &state->mouse.x, &state->mouse.y);
    return Window(std::move(state));
}

glm::uvec2 Window::size() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(state_->window, &width, &height);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

void Window::resize(uint32_t width, uint32_t height) {
    glfwSetWindowSize(state_->window, static_cast<int>(width), static_cast<int>(height));
}

WindowInput Window::poll() {
    glfwPollEvents();
    glm::dvec2 mouse(0.0);
    glfwGetCursorPos(state_->window, &mouse.x, &mouse.y);
    WindowInput input = std::exchange(state_->input, {});
    if (glfwGetMouseButton(state_->window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) {
        input.drag = mouse - state_->mouse;
    }
    state_->mouse = mouse;
    return input;
}

bool Window::is_closed() const {
    return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(state_->window, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::swap() {
    glfwSwapBuffers(state_->window);
}

}  // namespace tetralight
