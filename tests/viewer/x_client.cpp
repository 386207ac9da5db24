#include "tests/viewer/x_client.h"

#include <chrono>
#include <functional>
#include <thread>

#include <X11/Xatom.h>
#include <X11/Xlib.h>

namespace fluxwalk::testing {
namespace {

constexpr int kDropVersion = 5;
constexpr auto kPatience = std::chrono::seconds(20);

class Client {
  public:
    Client() : display_(XOpenDisplay(nullptr)) {
        if (display_ != nullptr) {
            own_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
            target_ = findTarget();
        }
    }
    ~Client() {
        if (display_ != nullptr) {
            XCloseDisplay(display_);
        }
    }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    bool hasTarget() const { return target_ != 0; }
    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    void send(const char* type, long a, long b, long c, long d, long e) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        const long values[] = {a, b, c, d, e};
        for (int i = 0; i < 5; ++i) {
            event.xclient.data.l[i] = values[i];
        }
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    /// Waits for a message of this type; answers requests for what is dragged meanwhile.
    bool waitFor(const char* type, const std::string& dragged) const {
        const auto end = std::chrono::steady_clock::now() + kPatience;
        while (std::chrono::steady_clock::now() < end) {
            while (XPending(display_) > 0) {
                XEvent event{};
                XNextEvent(display_, &event);
                if (event.type == SelectionRequest) {
                    answer(event.xselectionrequest, dragged);
                } else if (event.type == ClientMessage && event.xclient.message_type == atom(type)) {
                    return true;
                }
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }

    bool drop(const std::string& file) const {
        const std::string dragged = "file://" + file + "\r\n";
        const auto own = static_cast<long>(own_);
        XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);
        send("XdndEnter", own, static_cast<long>(kDropVersion) << 24,
             static_cast<long>(atom("text/uri-list")), 0, 0);
        send("XdndPosition", own, 0, (700L << 16) | 450L, CurrentTime,
             static_cast<long>(atom("XdndActionCopy")));
        if (!waitFor("XdndStatus", dragged)) {
            return false;
        }
        send("XdndDrop", own, 0, CurrentTime, 0, 0);
        return waitFor("XdndFinished", dragged);
    }

    void close() const {
        send("WM_PROTOCOLS", static_cast<long>(atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0, 0);
        XSync(display_, False);
    }

  private:
    void answer(const XSelectionRequestEvent& request, const std::string& text) const {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
        XEvent reply{};
        reply.xselection.type = SelectionNotify;
        reply.xselection.requestor = request.requestor;
        reply.xselection.selection = request.selection;
        reply.xselection.target = request.target;
        reply.xselection.property = request.property;
        reply.xselection.time = request.time;
        XSendEvent(display_, request.requestor, False, NoEventMask, &reply);
        XFlush(display_);
    }

    ::Window findTarget() const {
        ::Window root = 0;
        ::Window parent = 0;
        ::Window* children = nullptr;
        unsigned count = 0;
        ::Window found = 0;
        XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count);
        for (unsigned i = 0; i < count; ++i) {
            int properties = 0;
            Atom* const atoms = XListProperties(display_, children[i], &properties);
            for (int k = 0; k < properties; ++k) {
                if (atoms[k] == atom("XdndAware")) {
                    found = children[i];
                }
            }
            XFree(atoms);
        }
        XFree(children);
        return found;
    }

    Display* display_;
    ::Window own_ = 0;
    ::Window target_ = 0;
};

}  // namespace

bool dropFile(const std::string& file) {
    const Client client;
    return client.hasTarget() && client.drop(file);
}

bool closeWindow() {
    const Client client;
    if (client.hasTarget()) {
        client.close();
    }
    return client.hasTarget();
}

}  // namespace fluxwalk::testing
