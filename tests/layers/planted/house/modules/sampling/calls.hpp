namespace insonify {
struct Calls {
  std::function<void()> call;
};
}  // namespace insonify
