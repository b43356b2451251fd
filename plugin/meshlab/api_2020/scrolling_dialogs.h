// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// MeshLab 2020.09 makes a filter's dialog as high as its parameters are many, with the button that runs the filter at the
// bottom, where nobody reaches it on a lower screen. Ours get a scroll bar there, and else the height that they need.

#include <QObject>

class ScrollingDialogs : public QObject {
public:
    /// For dialogs of this application whose titles begin so, while the object lives.
    ScrollingDialogs(const QString& title, QObject* parent);

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QString title_;
};
