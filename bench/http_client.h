// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <tetralight/base/process/descriptor.h>

namespace tetralight::bench {

/// A persistent HTTP connection with the subset of HTTP that these benchmarks need. Any failure
/// ends the program.
class HttpClient {
  public:
    explicit HttpClient(uint16_t port);

    /// Sends the bytes of a request.
    void send(std::string_view request);

    struct Answer {
        unsigned status = 0;
        std::string_view body;  ///< valid until the next call
    };

    /// Waits for the response.
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

/// The bytes of a whole request.
[[nodiscard]] std::string http_request(const std::string& method, const std::string& path,
                                       const std::string& content_type = "",
                                       std::string_view body = "");

/// A server in a child process, which the destructor ends.
class ServerProcess {
  public:
    /// Runs `tetralight serve` and discards its log.
    ServerProcess(const std::string& program, const std::string& data);

    /// Runs `serve` in a child process; it must call its argument with the port.
    explicit ServerProcess(
        const std::function<void(const std::function<void(uint16_t)>& is_listening)>& serve);

    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;
    ~ServerProcess();

    [[nodiscard]] uint16_t port() const { return port_; }

    /// Processor time of the server so far, without its children.
    [[nodiscard]] double cpu_seconds() const;

  private:
    pid_t pid_ = -1;
    uint16_t port_ = 0;
};

/// Processor time of this process.
[[nodiscard]] double own_cpu_seconds();

}  // namespace tetralight::bench
