#include "tests/devices/fakes/fake_haply.h"

#include <sys/socket.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace reachlab::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Json = nlohmann::json;
using Tcp = asio::ip::tcp;

Json vector(const Vec3& v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }

}  // namespace

FakeHaply::FakeHaply(Speaks speaks, const std::vector<std::string>& ids) : speaks_(speaks) {
  for (const std::string& id : ids) devices_.push_back({id, std::to_string(61548 + devices_.size()), {}, {}});
  std::atomic<bool> listening{false};
  thread_ = std::thread([this, &listening] { run(listening); });
  listening.wait(false);
}

void FakeHaply::run(std::atomic<bool>& listening) {
  asio::io_context io;
  Tcp::acceptor acceptor(io, {asio::ip::make_address("127.0.0.1"), 0});
  port_ = acceptor.local_endpoint().port();
  listener_ = acceptor.native_handle();
  listening = true;
  listening.notify_one();
  while (!ending_) {
    beast::error_code fault;
    const auto socket = std::make_shared<Tcp::socket>(io);
    acceptor.accept(*socket, fault);
    if (fault || ending_) break;
    clients_.emplace_back([this, socket] { serve(socket); });
  }
  listener_ = -1;
  for (std::thread& client : clients_) client.join();
}

void FakeHaply::serve(std::shared_ptr<Tcp::socket> socket) {
  const int connection = socket->native_handle();
  {
    const std::lock_guard lock(mutex_);
    connections_.insert(connection);
  }
  try {
    if (speaks_ == Speaks::NoWebsocket) {
      asio::write(*socket, asio::buffer(std::string("220 some other service\r\n")));
    } else {
      socket->set_option(Tcp::no_delay(true));
      beast::websocket::stream<Tcp::socket&> stream(*socket);
      stream.accept();
      stream.text(true);
      if (speaks_ == Speaks::ClosesAtOnce) stream.close(beast::websocket::close_code::normal);
      bool first = true;
      const auto tell = [&] {
        stream.write(asio::buffer(state(first)));
        first = false;
      };
      if (speaks_ == Speaks::GreetsFirst) tell();
      while (!ending_) {
        beast::flat_buffer message;
        stream.read(message);
        hear(beast::buffers_to_string(message.data()));
        tell();
      }
    }
  } catch (const std::exception&) {  // the client or the test has closed it
  }
  const std::lock_guard lock(mutex_);
  connections_.erase(connection);
  beast::error_code ignored;
  socket->close(ignored);
}

FakeHaply::~FakeHaply() {
  end();
  thread_.join();
}

void FakeHaply::end() {
  ending_ = true;
  const std::lock_guard lock(mutex_);
  for (const int connection : connections_) ::shutdown(connection, SHUT_RDWR);
  if (const int at = listener_; at >= 0) ::shutdown(at, SHUT_RDWR);
}

const FakeHaply::Device& FakeHaply::deviceOf(const std::string& id) const {
  const auto at = std::find_if(devices_.begin(), devices_.end(), [&](const Device& device) { return device.id == id; });
  if (at == devices_.end()) throw std::out_of_range(id);
  return *at;
}

void FakeHaply::moveTo(const Vec3& cursor, const std::string& id) {
  const std::lock_guard lock(mutex_);
  deviceOf(id).cursor = cursor;
}

void FakeHaply::moveBy(std::function<Vec3(double)> law) {
  const std::lock_guard lock(mutex_);
  law_ = std::move(law);
}

Vec3 FakeHaply::lastForce(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return deviceOf(id).force;
}

double FakeHaply::largestForce(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return deviceOf(id).largest;
}

void FakeHaply::setPlugged(bool plugged, const std::string& id) {
  const std::lock_guard lock(mutex_);
  deviceOf(id).plugged = plugged;
}

void FakeHaply::hear(const std::string& text) {
  const std::lock_guard lock(mutex_);
  const Json message = Json::parse(text, nullptr, false);
  if (!message.is_object() || !message.contains("inverse3")) return;
  for (const Json& command : message["inverse3"])
    for (Device& device : devices_) {
      if (command.value("device_id", "") != device.id) continue;
      const Json& values = command["commands"]["set_cursor_force"]["values"];
      device.force = {values["x"], values["y"], values["z"]};
      device.largest = std::max(device.largest, norm(device.force));
    }
}

std::string FakeHaply::state(bool first) const {
  const std::lock_guard lock(mutex_);
  if (speaks_ == Speaks::Garbage) return "\x01\x02 not a message {";
  if (speaks_ == Speaks::OldObjects) return Json{{"inverse3", {{kFirst, {{"state", {{"cursor_position", vector({})}}}}}}}}.dump();
  Json devices = Json::array(), grips = Json::array();
  for (const Device& known : devices_) {
    // Of the first one a and c are pressed, of the others b.
    const bool isFirst = known.id == devices_.front().id;
    grips.push_back({{"device_id", known.grip},
                     {"state",
                      {{"orientation", {{"w", 0.0}, {"x", 0.0}, {"y", 0.6}, {"z", 0.8}}},
                       {"buttons", {{"a", isFirst}, {"b", !isFirst}, {"c", isFirst}}}}}});
    if (speaks_ == Speaks::NoDevice || !known.plugged) continue;
    const Vec3 cursor = law_ ? law_(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count()) : known.cursor;
    Json device = {{"device_id", known.id}, {"state", {{"cursor_position", vector(cursor)}, {"cursor_velocity", vector({0.1, 0.2, 0.3})}}}};
    if (first) device["config"] = {{"gravity_compensation", {{"enabled", true}}}, {"handedness", "right"}};
    devices.push_back(device);
  }
  return Json{{"inverse3", devices}, {"wireless_verse_grip", grips}}.dump();
}

}  // namespace reachlab::test
