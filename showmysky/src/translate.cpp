#include "translate.hpp"

namespace showmysky {

void rethrowTranslated()
{
    try {
        throw;
    } catch (const Error&) {
        throw;
    } catch (const sky::ModelError& error) {
        throw Error(ErrorKind::model, error.what());
    } catch (const sky::FileError& error) {
        throw Error(ErrorKind::model, error.what());
    } catch (const sky::RangeError& error) {
        throw Error(ErrorKind::settings, error.what());
    } catch (const sky::GlError& error) {
        throw Error(ErrorKind::openGl, error.what());
    } catch (const sky::Cancelled& error) {
        throw Error(ErrorKind::cancelled, error.what());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::other, "There is not enough memory for this sky.");
    } catch (const std::exception& error) {
        throw Error(ErrorKind::other, error.what());
    }
}

} // namespace showmysky
