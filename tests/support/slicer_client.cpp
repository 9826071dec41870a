#include "support/slicer_client.hpp"

#include <igtlClientSocket.h>
#include <igtlMessageHeader.h>
#include <igtlPolyDataMessage.h>
#include <igtlSensorMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTransformMessage.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "support/igtl_by_the_book.hpp"

namespace ream::test {
namespace {

constexpr int timeout_ms = 120'000;

template <typename LibraryMessage>
typename LibraryMessage::Pointer unpacked(igtl::MessageHeader::Pointer header, const std::byte* body) {
  typename LibraryMessage::Pointer message = LibraryMessage::New();
  message->SetMessageHeader(header);
  message->AllocatePack();
  std::memcpy(message->GetPackBodyPointer(), body, static_cast<size_t>(message->GetPackBodySize()));
  if ((message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY) == 0)
    throw std::runtime_error("the library refuses a message");
  return message;
}

void read_transform(igtl::TransformMessage& message, IgtlReading& reading) {
  igtl::Matrix4x4 matrix;
  message.GetMatrix(matrix);
  for (size_t column = 0; column < 4; ++column)
    for (size_t row = 0; row < 3; ++row) reading.transform[3 * column + row] = matrix[row][column];
}

void read_polydata(igtl::PolyDataMessage& message, IgtlReading& reading) {
  reading.points.resize(static_cast<size_t>(message.GetPoints()->GetNumberOfPoints()));
  for (size_t i = 0; i < reading.points.size(); ++i)
    message.GetPoints()->GetPoint(static_cast<unsigned int>(i), reading.points[i].data());
  reading.triangles.resize(message.GetPolygons()->GetNumberOfCells());
  for (size_t i = 0; i < reading.triangles.size(); ++i) {
    if (message.GetPolygons()->GetCellSize(static_cast<unsigned int>(i)) != 3)
      throw std::runtime_error("the library reads a polygon that is no triangle");
    message.GetPolygons()->GetCell(static_cast<unsigned int>(i), reading.triangles[i].data());
  }
  if (message.GetNumberOfAttributes() == 0) return;
  igtl::PolyDataAttribute* normals = message.GetAttribute(0);
  if (normals->GetType() != igtl::PolyDataAttribute::POINT_NORMAL)
    throw std::runtime_error("the library reads an attribute that is no normal");
  reading.normals.resize(normals->GetSize());
  for (size_t i = 0; i < reading.normals.size(); ++i)
    normals->GetNthData(static_cast<unsigned int>(i), reading.normals[i].data());
}

}  // namespace

IgtlReading read_by_library(const IgtlBytes& bytes) {
  igtl::MessageHeader::Pointer header = igtl::MessageHeader::New();
  header->InitPack();
  if (bytes.size() < static_cast<size_t>(header->GetPackSize())) throw std::runtime_error("no whole header");
  std::memcpy(header->GetPackPointer(), bytes.data(), static_cast<size_t>(header->GetPackSize()));
  const std::byte* body = bytes.data() + header->GetPackSize();
  header->Unpack();
  IgtlReading reading;
  reading.type = header->GetDeviceType();
  reading.name = header->GetDeviceName();
  unsigned int seconds = 0, fraction = 0;
  header->GetTimeStamp(&seconds, &fraction);
  reading.stamp = static_cast<uint64_t>(seconds) << 32 | fraction;
  if (reading.type == "TRANSFORM") {
    read_transform(*unpacked<igtl::TransformMessage>(header, body), reading);
  } else if (reading.type == "POLYDATA") {
    read_polydata(*unpacked<igtl::PolyDataMessage>(header, body), reading);
  } else if (reading.type == "SENSOR") {
    const auto sensor = unpacked<igtl::SensorMessage>(header, body);
    reading.unit = sensor->GetUnit();
    for (unsigned int i = 0; i < sensor->GetLength(); ++i) reading.values.push_back(sensor->GetValue(i));
  } else if (reading.type == "STRING") {
    reading.text = unpacked<igtl::StringMessage>(header, body)->GetString();
  } else if (reading.type == "STATUS") {
    const auto status = unpacked<igtl::StatusMessage>(header, body);
    reading.code = static_cast<uint16_t>(status->GetCode());
    reading.error_name = status->GetErrorName();
    reading.text = status->GetStatusString();
  } else {
    throw std::runtime_error("type " + reading.type + " is not expected");
  }
  return reading;
}

struct SlicerClient::Line {
  igtl::ClientSocket::Pointer socket = igtl::ClientSocket::New();
};

SlicerClient::SlicerClient(uint16_t port) : line_(std::make_unique<Line>()) {
  if (line_->socket->ConnectToServer("127.0.0.1", port) != 0)
    throw std::runtime_error("nobody listens at port " + std::to_string(port));
  line_->socket->SetReceiveTimeout(timeout_ms);
}

SlicerClient::~SlicerClient() { line_->socket->CloseSocket(); }

IgtlBytes SlicerClient::raw(size_t count) {
  IgtlBytes bytes(count);
  for (size_t done = 0; done < count;) {
    errno = 0;
    const int got = line_->socket->Receive(bytes.data() + done, static_cast<int>(count - done), 0);
    if (got > 0)
      done += static_cast<size_t>(got);
    else if (errno != EINTR)  // the test was stopped for a while
      throw std::runtime_error("the line has ended, or nothing came");
  }
  return bytes;
}

void SlicerClient::say(const IgtlBytes& bytes) {
  line_->socket->Send(bytes.data(), static_cast<int>(bytes.size()));
}

IgtlBytes SlicerClient::next() {
  IgtlBytes message = raw(IgtlByTheBook::header_bytes);
  const IgtlBytes body = raw(IgtlByTheBook::body_bytes(message));
  message.insert(message.end(), body.begin(), body.end());
  return message;
}

IgtlReading SlicerClient::hear_until(const std::string& what,
                                     const std::function<bool(const IgtlReading&)>& wanted) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  const auto next_or_say = [&] {
    try {
      return next();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("waited for " + what + ": " + error.what());
    }
  };
  while (std::chrono::steady_clock::now() < end) {
    const IgtlBytes bytes = next_or_say();
    const IgtlReading reading = IgtlByTheBook::read(bytes);
    if (reading != read_by_library(bytes))
      throw std::runtime_error("the two readers differ in a " + reading.type + " " + reading.name);
    if (wanted(reading)) return reading;
  }
  throw std::runtime_error("waited in vain for " + what);
}

}  // namespace ream::test
