<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="ja" sourcelanguage="en">
<context>
    <name>Subject</name>
    <message>
        <source>Please wait</source>
        <translation>お待ちください</translation>
    </message>
    <message>
        <source>Move to the grey sphere and rest there</source>
        <translation>灰色の球に移動して止まってください</translation>
    </message>
    <message>
        <source>Wait for the signal</source>
        <translation>合図を待ってください</translation>
    </message>
    <message>
        <source>Move to the yellow sphere</source>
        <translation>黄色の球に動かしてください</translation>
    </message>
    <message>
        <source>Go</source>
        <translation>スタート</translation>
    </message>
    <message>
        <source>Well done</source>
        <translation>よくできました</translation>
    </message>
    <message>
        <source>Too fast</source>
        <translation>速すぎます</translation>
    </message>
    <message>
        <source>Not at the target in time</source>
        <translation>時間内に目標に届きませんでした</translation>
    </message>
    <message>
        <source>Not at rest in time</source>
        <translation>時間内に静止しませんでした</translation>
    </message>
    <message>
        <source>Not through every ball on the way</source>
        <translation>途中の球をすべて通過しませんでした</translation>
    </message>
    <message>
        <source>Too early: wait for the signal</source>
        <translation>早すぎます：合図を待ってください</translation>
    </message>
    <message>
        <source>No movement began</source>
        <translation>動きがありませんでした</translation>
    </message>
    <message>
        <source>This trial does not count</source>
        <translation>この試行は数えません</translation>
    </message>
    <message>
        <source>Rest a little</source>
        <translation>少し休んでください</translation>
    </message>
    <message>
        <source>That was all: thank you</source>
        <translation>これで終わりです。ありがとうございました</translation>
    </message>
</context>
</TS>
