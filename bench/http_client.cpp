// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/http_client.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <ctime>

#include <tetralight/base/str_cat.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {

HttpClient::HttpClient(uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int connected =
        ::connect(socket_.value(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
    require(connected == 0, "no connection to the server");
    const int on = 1;
    ::setsockopt(socket_.value(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

void HttpClient::send(std::string_view request) {
    while (!request.empty()) {
        const ssize_t count = ::send(socket_.value(), request.data(), request.size(), MSG_NOSIGNAL);
        require(count > 0, "the server closed the connection");
        request.remove_prefix(static_cast<size_t>(count));
    }
}

HttpClient::Answer HttpClient::receive() {
    received_.erase(0, used_);
    used_ = 0;
    size_t filled = received_.size();
    size_t needed = std::string::npos;
    Answer answer;
    size_t head = 0;
    while (filled < needed) {
        constexpr size_t kLeast = size_t{64} << 10;
        received_.resize(std::max(filled + kLeast, needed == std::string::npos ? 0 : needed));
        const ssize_t count =
            ::recv(socket_.value(), received_.data() + filled, received_.size() - filled, 0);
        require(count > 0, "the server closed the connection");
        filled += static_cast<size_t>(count);
        if (needed != std::string::npos) continue;
        const std::string_view text(received_.data(), filled);
        head = text.find("\r\n\r\n");
        if (head == std::string_view::npos) continue;
        head += 4;
        answer.status = static_cast<unsigned>(std::atoi(received_.data() + 9));
        const size_t length = text.find("Content-Length: ");
        needed = head;
        if (length < head)
            needed += static_cast<size_t>(std::atoll(received_.data() + length + 16));
    }
    received_.resize(filled);
    answer.body = std::string_view(received_).substr(head, needed - head);
    used_ = needed;
    return answer;
}

std::string http_request(const std::string& method, const std::string& path,
                         const std::string& content_type, std::string_view body) {
    std::string request = method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n";
    if (!content_type.empty()) request += "Content-Type: " + content_type + "\r\n";
    request += str_cat("Content-Length: ", body.size(), "\r\n\r\n", body);
    return request;
}

ServerProcess::ServerProcess(const std::string& program, const std::string& data) {
    int ends[2];
    require(::pipe(ends) == 0, "no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        ::dup2(ends[1], STDOUT_FILENO);
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        ::close(ends[0]);
        ::execl(program.c_str(), program.c_str(), "serve", "--data", data.c_str(), "--listen",
                "127.0.0.1:0", nullptr);
        ::_exit(127);
    }
    ::close(ends[1]);
    std::string line;
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(ends[0]);
    const size_t colon = line.rfind(':');
    require(colon != std::string::npos, "the server does not start: " + program);
    port_ = static_cast<uint16_t>(std::atoi(line.c_str() + colon + 1));
}

ServerProcess::ServerProcess(
    const std::function<void(const std::function<void(uint16_t)>& is_listening)>& serve) {
    int ends[2];
    require(::pipe(ends) == 0, "no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        serve([&](uint16_t port) {
            [[maybe_unused]] const ssize_t written = ::write(ends[1], &port, sizeof port);
        });
        ::_exit(0);
    }
    require(::read(ends[0], &port_, sizeof port_) == sizeof port_, "the baseline does not start");
    ::close(ends[0]);
    ::close(ends[1]);
}

ServerProcess::~ServerProcess() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
}

double ServerProcess::cpu_seconds() const {
    clockid_t clock = 0;
    timespec time = {};
    require(::clock_getcpuclockid(pid_, &clock) == 0 && ::clock_gettime(clock, &time) == 0,
            "the processor time of the server is not known");
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
}

double own_cpu_seconds() {
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace tetralight::bench
