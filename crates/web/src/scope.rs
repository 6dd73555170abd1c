//! What a device says to something that is made.

/// Makes something, and returns it with the first thing that the device refused of it.
pub(crate) async fn scoped<T>(
    device: &wgpu::Device,
    make: impl FnOnce() -> T,
) -> (T, Option<String>) {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    let (validation, internal, memory) = (validation.pop(), internal.pop(), memory.pop());
    let (validation, internal, memory) = (validation.await, internal.await, memory.await);
    let error = validation.or(internal).or(memory);
    (made, error.map(|error| error.to_string()))
}
