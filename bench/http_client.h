// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <tetralight/base/descriptor.h>

namespace tetralight::bench {

/// A connection that stays open. As little of HTTP as it takes to measure servers of our own; what
/// goes wrong ends the benchmark.
class HttpClient {
  public:
    explicit HttpClient(uint16_t port);

    /// Sends a request's bytes.
    void send(std::string_view request);

    struct Answer {
        unsigned status = 0;
        std::string_view body;  ///< until the next call
    };

    /// Waits for the answer.
    Answer receive();

    Answer ask(std::string_view request) {
        send(request);
        return receive();
    }

    [[nodiscard]] int descriptor() const { return socket_.value(); }

  private:
    Descriptor socket_;
    std::string received_;
    size_t used_ = 0;
};

/// A whole request.
[[nodiscard]] std::string http_request(const std::string& method, const std::string& path,
                                       const std::string& content_type = "",
                                       std::string_view body = "");

/// A server in a process of its own, ended with this object.
class ServerProcess {
  public:
    /// `tetralight serve` with these options; its log goes to nowhere.
    ServerProcess(const std::string& program, const std::string& data);

    /// `serve` in a child of this process: it gets a function to call with the port.
    explicit ServerProcess(
        const std::function<void(const std::function<void(uint16_t)>& is_listening)>& serve);

    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;
    ~ServerProcess();

    [[nodiscard]] uint16_t port() const { return port_; }

    /// Processor time that it took so far, that of its children left out.
    [[nodiscard]] double cpu_seconds() const;

  private:
    pid_t pid_ = -1;
    uint16_t port_ = 0;
};

/// Processor time of this process.
[[nodiscard]] double own_cpu_seconds();

}  // namespace tetralight::bench
